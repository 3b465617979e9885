// The OpenNI2 driver module libSaccadeVirtual: the source named by SACCADE_VIRTUAL_DEVICE (virtual_spec.hpp)
// as a live device, to any OpenNI2 program.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "drivers/modules/announcer.hpp"
#include "drivers/modules/virtual_device.hpp"

// OpenNI2's macro below makes and deletes the driver with these.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

namespace saccade {
namespace {

constexpr const char* kVariable = "SACCADE_VIRTUAL_DEVICE";
constexpr const char* kUri = "saccade-virtual://0";

// The folder in which the program was started, whose paths the user means. While OpenNI2 loads a module it is
// in the module's folder, with the whole program or, as ours does it, with one thread. In the first case
// only PWD, which the shell sets, names the folder.
std::filesystem::path folder_of_program() {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path here = fs::current_path(code);
  fs::path main_thread = fs::read_symlink("/proc/self/cwd", code);
  if (!main_thread.empty() && main_thread != here) return main_thread;
  const char* shell = std::getenv("PWD");
  return shell != nullptr && fs::path(shell).is_absolute() ? fs::path(shell) : here;
}

class VirtualDriver final : public oni::driver::DriverBase {
 public:
  explicit VirtualDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    const char* text = std::getenv(kVariable);
    if (text == nullptr || *text == '\0') return ONI_STATUS_OK;
    try {
      spec_ = parse_virtual(text);
      spec_->source = seen_from(folder_of_program(), spec_->source);
      open_playable(*spec_);  // now, so that the user learns at once what is wrong
    } catch (const std::exception& error) {
      report(error.what());
      return ONI_STATUS_OK;  // a driver without devices
    }
    announcer_.emplace();
    if (spec_->late.count() == 0)
      appear();
    else
      announcer_->at(Announcer::Clock::now() + spec_->late, [this] { appear(); });
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    if (std::string(uri) != kUri) return nullptr;
    if (!present()) {
      getServices().errorLoggerAppend("the virtual device is not there at the moment");
      return nullptr;
    }
    try {
      return new VirtualDevice(*spec_, open_playable(*spec_), first_frame(),
                               {[this] { return present(); }, [this] { count(); },
                                [this](const std::string& why) {
                                  report(why);
                                  vanish(VirtualSpec::Loss::event);
                                }});
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override { announcer_.reset(); }

  // Streams of one device always have one clock and one time stamp per frame.
  void* enableFrameSync(oni::driver::StreamBase**, int) override { return this; }

 private:
  static void report(const std::string& what) {
    std::fprintf(stderr, "virtual device: %s: %s\n", kVariable, what.c_str());
  }

  bool present() const {
    const std::lock_guard lock(mutex_);
    return present_;
  }

  std::int64_t first_frame() const {
    const std::lock_guard lock(mutex_);
    return was_lost_ ? spec_->back_at : 0;
  }

  // On the announcer's thread, or before there are devices.
  void appear() {
    set_present();
    deviceConnected(&info_);
  }

  void set_present() {
    const std::lock_guard lock(mutex_);
    present_ = true;
    frames_ = 0;
  }

  void count() {
    {
      const std::lock_guard lock(mutex_);
      if (!present_ || ++frames_ != spec_->loss_after) return;
    }
    vanish(spec_->loss);
    if (!spec_->back_after) return;
    announcer_->at(Announcer::Clock::now() + *spec_->back_after, [this] {
      if (spec_->loss == VirtualSpec::Loss::event) return appear();
      set_present();
      if (spec_->loss == VirtualSpec::Loss::state) deviceStateChanged(&info_, ONI_DEVICE_STATE_OK);
    });
  }

  void vanish(VirtualSpec::Loss loss) {
    {
      const std::lock_guard lock(mutex_);
      present_ = false;
      was_lost_ = true;
    }
    if (loss == VirtualSpec::Loss::event) announcer_->now([this] { deviceDisconnected(&info_); });
    if (loss == VirtualSpec::Loss::state)
      announcer_->now([this] { deviceStateChanged(&info_, ONI_DEVICE_STATE_ERROR); });
  }

  const OniDeviceInfo info_ = device_info(kUri, "Saccade", "Virtual device", 0, 0);
  std::optional<VirtualSpec> spec_;
  mutable std::mutex mutex_;
  bool present_ = false;     // guarded by mutex_
  bool was_lost_ = false;    // guarded by mutex_
  std::int64_t frames_ = 0;  // guarded by mutex_; given since it appeared
  std::optional<Announcer> announcer_;
};

}  // namespace
}  // namespace saccade

ONI_EXPORT_DRIVER(saccade::VirtualDriver)
