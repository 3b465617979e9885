#include "drivers/openni2/openni2_runtime.hpp"

#include <sched.h>

#include <algorithm>
#include <sstream>

#include <OpenNI.h>

#include "core/error.hpp"
#include "core/outcome.hpp"
#include "drivers/openni2/openni2_thread.hpp"

namespace saccade {
namespace {

DeviceIdentity identity_of(const openni::DeviceInfo& info) {
  return {info.getUri(), info.getVendor(), info.getName(), info.getUsbVendorId(), info.getUsbProductId()};
}

// OpenNI2 changes to the folder of its modules while it loads them, and a relative path that another thread
// opens just then would be another file. So the thread that uses it gets a working directory of its own;
// where a sandbox does not allow that, OpenNI2 starts all the same.
Outcome start_openni2() {
  Outcome outcome = Outcome::success();
  on_openni2_thread([&outcome] {
    ::unshare(CLONE_FS);
    if (openni::OpenNI::initialize() == openni::STATUS_OK) return;
    outcome = Outcome::failure(openni2_complaint());
    openni::OpenNI::shutdown();
  });
  return outcome;
}

}  // namespace

// Its lines end and begin with white space.
std::string openni2_complaint() {
  std::istringstream lines(openni::OpenNI::getExtendedError());
  std::string complaint;
  for (std::string line; std::getline(lines >> std::ws, line);)
    complaint += (complaint.empty() ? "" : "; ") + line;
  return complaint.empty() ? "it does not say why" : complaint;
}

// OpenNI2 calls it on the threads of its drivers, which may hold locks; so it only takes notes.
class OpenNi2Runtime::Listener final : public openni::OpenNI::DeviceConnectedListener,
                                       public openni::OpenNI::DeviceDisconnectedListener,
                                       public openni::OpenNI::DeviceStateChangedListener {
 public:
  void onDeviceConnected(const openni::DeviceInfo*) override {
    const std::lock_guard lock(mutex_);
    ++arrivals_;
  }

  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    note(info->getUri(), "it was disconnected");
  }

  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override {
    if (state == openni::DEVICE_STATE_OK)
      onDeviceConnected(info);
    else
      note(info->getUri(), "it reports an error");
  }

  Trouble trouble(const std::string& uri) const {
    const std::lock_guard lock(mutex_);
    const auto found = troubles_.find(uri);
    return found == troubles_.end() ? Trouble{} : found->second;
  }

  std::int64_t arrivals() const {
    const std::lock_guard lock(mutex_);
    return arrivals_;
  }

 private:
  void note(const std::string& uri, const char* text) {
    const std::lock_guard lock(mutex_);
    Trouble& trouble = troubles_[uri];
    ++trouble.count;
    trouble.text = text;
  }

  mutable std::mutex mutex_;
  std::map<std::string, Trouble> troubles_;  // guarded by mutex_
  std::int64_t arrivals_ = 0;                // guarded by mutex_
};

OpenNi2Runtime& OpenNi2Runtime::instance() {
  static OpenNi2Runtime runtime;
  return runtime;
}

OpenNi2Runtime::OpenNi2Runtime() : listener_(std::make_unique<Listener>()) {
  if (const Outcome outcome = start_openni2(); !outcome)
    throw failed("OpenNI2 does not start", outcome.reason(), "saccade doctor looks for the reason");
  on_openni2_thread([this] {
    openni::OpenNI::addDeviceConnectedListener(listener_.get());
    openni::OpenNI::addDeviceDisconnectedListener(listener_.get());
    openni::OpenNI::addDeviceStateChangedListener(listener_.get());
  });
}

OpenNi2Runtime::~OpenNi2Runtime() {
  on_openni2_thread([this] {
    openni::OpenNI::removeDeviceConnectedListener(listener_.get());
    openni::OpenNI::removeDeviceDisconnectedListener(listener_.get());
    openni::OpenNI::removeDeviceStateChangedListener(listener_.get());
    openni::OpenNI::shutdown();
  });
}

std::vector<DeviceIdentity> OpenNi2Runtime::devices() const {
  std::vector<DeviceIdentity> devices;
  on_openni2_thread([&devices] {
    openni::Array<openni::DeviceInfo> list;
    openni::OpenNI::enumerateDevices(&list);
    for (int i = 0; i < list.getSize(); ++i) devices.push_back(identity_of(list[i]));
  });
  return devices;
}

OpenNi2Runtime::Trouble OpenNi2Runtime::trouble(const std::string& uri) const {
  return listener_->trouble(uri);
}

std::int64_t OpenNi2Runtime::arrivals() const { return listener_->arrivals(); }

int choose_device(const std::vector<DeviceIdentity>& devices, const std::string& wanted,
                  const std::optional<DeviceIdentity>& last) {
  const auto position = [&](const std::string& uri) {
    const auto found =
        std::find_if(devices.begin(), devices.end(), [&](const auto& device) { return device.uri == uri; });
    return found == devices.end() ? -1 : static_cast<int>(found - devices.begin());
  };
  if (last)
    if (const int same = position(last->uri); same >= 0) return same;
  if (wanted.empty()) return devices.empty() ? -1 : 0;
  if (const int named = position(wanted); named >= 0) return named;
  if (!last) return -1;
  const auto alike = [&](const DeviceIdentity& device) {
    return device.usb_vendor == last->usb_vendor && device.usb_product == last->usb_product &&
           device.vendor == last->vendor && device.name == last->name;
  };
  if (std::count_if(devices.begin(), devices.end(), alike) != 1) return -1;
  return static_cast<int>(std::find_if(devices.begin(), devices.end(), alike) - devices.begin());
}

}  // namespace saccade
