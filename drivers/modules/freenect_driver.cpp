// The OpenNI2 driver module libSaccadeFreenect: Kinect v1, through libfreenect.
#include <algorithm>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/modules/announcer.hpp"
#include "drivers/modules/freenect_device.hpp"

// OpenNI2's macro below makes and deletes the driver with these.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

namespace saccade {
namespace {

constexpr int kMicrosoft = 0x045e, kKinectCamera = 0x02ae;

// The Kinects are counted once a second; they are known by their place in that count, because asking for
// their serial numbers would open them. One that is unplugged while it streams is noticed at once;
// libfreenect does not say which it was, so all that stream are reported as lost, and the next count brings
// back those that are there.
class FreenectDriver final : public oni::driver::DriverBase {
 public:
  explicit FreenectDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    try {
      announcer_.emplace();
      loop_.emplace([this](int count) { announcer_->now([this, count] { counted(count); }); },
                    [this] { announcer_->now([this] { lost_while_streaming(); }); });
      // A program must find the devices when this returns. All counts are handled on the announcer's thread.
      int count = 0;
      loop_->run([&](freenect_context* context) { count = freenect_num_devices(context); });
      std::promise<void> counted_once;
      announcer_->now([&] {
        counted(count);
        counted_once.set_value();
      });
      counted_once.get_future().wait();
      return ONI_STATUS_OK;
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return ONI_STATUS_ERROR;
    }
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    try {
      const int index = index_of(uri);
      return index < 0 ? nullptr : new FreenectDevice(*loop_, index);
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override {
    if (announcer_) announcer_->stop();
    loop_.reset();
    announcer_.reset();
  }

 private:
  int index_of(const std::string& uri) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(infos_.begin(), infos_.end(),
                                    [&](const OniDeviceInfo& info) { return uri == info.uri; });
    return found == infos_.end() ? -1 : static_cast<int>(found - infos_.begin());
  }

  void counted(int count) {
    while (size() < count) {
      const int index = size();
      const OniDeviceInfo info = device_info("freenect://" + std::to_string(index), "Microsoft", "Kinect",
                                             kMicrosoft, kKinectCamera);
      {
        const std::lock_guard lock(mutex_);
        infos_.push_back(info);
      }
      deviceConnected(&info);
    }
    while (size() > std::max(count, 0)) remove_last();
  }

  void lost_while_streaming() {
    while (size() > 0) remove_last();
  }

  void remove_last() {
    OniDeviceInfo info;
    {
      const std::lock_guard lock(mutex_);
      info = infos_.back();
      infos_.pop_back();
    }
    deviceDisconnected(&info);
  }

  int size() {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(infos_.size());
  }

  std::mutex mutex_;
  std::vector<OniDeviceInfo> infos_;  // guarded by mutex_; of the Kinects that are there
  std::optional<Announcer> announcer_;
  std::optional<FreenectLoop> loop_;
};

}  // namespace
}  // namespace saccade

ONI_EXPORT_DRIVER(saccade::FreenectDriver)
