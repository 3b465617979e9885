// The OpenNI2 driver module libSaccadeBridge: the driver modules of other makers that SACCADE_OPENNI2_DRIVERS
// names, wherever they lie and whatever they are called. OpenNI2 itself takes modules from one folder only.
#include <dlfcn.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/modules/bridged_device.hpp"
#include "drivers/openni2/module_file.hpp"

// OpenNI2's macro below makes and deletes the driver with these.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

namespace saccade {
namespace {

class BridgeDriver final : public oni::driver::DriverBase {
 public:
  explicit BridgeDriver(OniDriverServices* services) : DriverBase(services), services_(services) {}

  // A module that cannot be used is left out: the others must work, and `saccade doctor` has the reasons.
  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    const auto files = named_modules(std::getenv(kModulesVariable));
    links_.reserve(files.size());  // modules keep pointers to them
    for (const auto& file : files)
      if (!trouble_with_module(file)) start(file);
    return ONI_STATUS_OK;
  }

  void shutdown() override {
    for (const Link& link : links_)
      if (link.running) link.module.functions.destroy();
  }

  OniStatus tryDevice(const char* uri) override {
    for (const Link& link : links_)
      if (link.running && link.module.functions.try_device(uri) == ONI_STATUS_OK) return ONI_STATUS_OK;
    return ONI_STATUS_ERROR;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* mode) override {
    const BridgedModule* module = module_of(uri);
    void* device = module == nullptr ? nullptr : module->functions.device_open(uri, mode);
    return device == nullptr ? nullptr : new BridgedDevice(*module, device);
  }

  void deviceClose(oni::driver::DeviceBase* device) override {
    const auto* bridged = static_cast<BridgedDevice*>(device);
    bridged->module().functions.device_close(bridged->handle());
    delete device;
  }

 private:
  // A module's connection to this driver.
  struct Link {
    BridgeDriver* driver = nullptr;
    BridgedModule module;
    bool running = false;
  };

  void start(const std::filesystem::path& file) {
    void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == nullptr) return;
    Link& link = links_.emplace_back(Link{this, {file, find_driver_functions(handle)}, false});
    link.module.functions.create(services_);
    link.running = link.module.functions.initialize(on_connected, on_disconnected, on_state_changed, &link) ==
                   ONI_STATUS_OK;
    if (!link.running) link.module.functions.destroy();
  }

  const BridgedModule* module_of(const std::string& uri) const {
    const std::lock_guard lock(mutex_);
    const auto found = module_of_.find(uri);
    return found == module_of_.end() ? nullptr : found->second;
  }

  // On the threads of the modules, also within initialize().
  static void on_connected(const OniDeviceInfo* info, void* cookie) {
    Link& link = *static_cast<Link*>(cookie);
    {
      const std::lock_guard lock(link.driver->mutex_);
      link.driver->module_of_[info->uri] = &link.module;
    }
    link.driver->deviceConnected(info);
  }

  static void on_disconnected(const OniDeviceInfo* info, void* cookie) {
    static_cast<Link*>(cookie)->driver->deviceDisconnected(info);
  }

  static void on_state_changed(const OniDeviceInfo* info, int state, void* cookie) {
    static_cast<Link*>(cookie)->driver->deviceStateChanged(info, state);
  }

  OniDriverServices* const services_;
  std::vector<Link> links_;
  mutable std::mutex mutex_;
  std::map<std::string, const BridgedModule*> module_of_;  // guarded by mutex_; by URI
};

}  // namespace
}  // namespace saccade

ONI_EXPORT_DRIVER(saccade::BridgeDriver)
