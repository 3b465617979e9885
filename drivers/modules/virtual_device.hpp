#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/frame_source.hpp"
#include "drivers/modules/module_device.hpp"
#include "drivers/modules/virtual_spec.hpp"

namespace saccade {

/// Opens the source of `spec` to be played as a device: it must be possible to read it again from its start,
/// and it must have a usable frame. Throws Error.
std::unique_ptr<FrameSource> open_playable(const VirtualSpec& spec);

/// A recorded or synthetic source as an OpenNI2 device. While a stream is started, a thread reads a frame at
/// a time at the rate of the mode (the faster of two) and hands depth and colour on with one time stamp, the
/// time since the device was opened at which the frame was due, and one index: the first shows the source's
/// frame first_frame, and the source begins again at its end. A frame that the source rejects is left out. A
/// stream of half the rate gets every other frame.
///
/// Depth is rounded to mm; depth beyond the range of 16 bits is no reading. A mode of half the
/// size shows the pixels of even rows and columns. Depth and colour of our sources are registered, whatever
/// the property says. Mirroring, cropping, modes and the settings of the camera are kept and read back.
class VirtualDevice final : public ModuleDevice {
 public:
  /// The device's connection to its driver; any thread.
  struct Plug {
    std::function<bool()> present;                     ///< plugged in: frames are handed on
    std::function<void()> count;                       ///< called after each frame
    std::function<void(const std::string& why)> fail;  ///< the source cannot be read any more
  };

  /// first_frame: of the source, 0..; one past its end is its first.
  VirtualDevice(const VirtualSpec& spec, std::unique_ptr<FrameSource> source, std::int64_t first_frame,
                Plug plug);
  ~VirtualDevice() override;

  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;

 private:
  OniStatus change_registration(OniImageRegistrationMode) override { return ONI_STATUS_OK; }
  bool change_running(bool start);
  void play(const std::stop_token& stop);
  std::chrono::nanoseconds give_next();
  void give(ModuleStream& stream, std::int64_t number, std::uint64_t timestamp_us);
  bool read_next();

  const VirtualSpec spec_;
  const FieldOfView view_;
  const Plug plug_;
  const std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::vector<std::shared_ptr<ModuleStream>> streams_;  // guarded by mutex_
  int running_ = 0;                                     // guarded by mutex_; streams that are started

  // The player's thread only.
  std::unique_ptr<FrameSource> source_;
  std::vector<std::shared_ptr<ModuleStream>> playing_;
  std::chrono::steady_clock::time_point due_;
  std::int64_t given_ = 0;
  Frame frame_;
  cv::Mat1w depth_, half_depth_;
  cv::Mat3b colour_, half_colour_;
  std::jthread player_;
};

}  // namespace saccade
