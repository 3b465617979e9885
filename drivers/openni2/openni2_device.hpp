#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "core/outcome.hpp"
#include "core/sensor_controls.hpp"
#include "core/sensor_settings.hpp"
#include "drivers/openni2/openni2_runtime.hpp"

namespace saccade {

/// One open sensor of OpenNI2 with its depth stream and, where it has one, its colour stream.
/// Thread safety: on_openni2_thread() only, from construction to destruction.
class OpenNi2Device {
 public:
  enum class Ready { nothing, depth, colour };

  /// Opens and starts it, then applies `settings` and `wanted` and reads them back; notes() has the
  /// differences. Throws Error: (usage) it lacks the mode in `settings`, (failed) it cannot be opened.
  OpenNi2Device(const DeviceIdentity& identity, const SensorSettings& settings, const SensorValues& wanted);
  ~OpenNi2Device();
  OpenNi2Device(const OpenNi2Device&) = delete;
  OpenNi2Device& operator=(const OpenNi2Device&) = delete;

  const DeviceIdentity& identity() const { return identity_; }
  cv::Size size() const { return size_; }  ///< of depth, and so of every frame
  int rate_hz() const { return rate_hz_; }
  const std::vector<SensorMode>& modes() const { return modes_; }  ///< in which it can give depth
  bool has_colour() const;
  /// From the field of view that the device reports for the camera that depth is seen from: with registration
  /// that is the colour camera. A guess where it reports none.
  const Intrinsics& intrinsics() const { return intrinsics_; }
  const std::vector<std::string>& notes() const { return notes_; }

  /// As read back after they were last set.
  const SensorValues& values() const { return values_; }
  /// Sets the values that `wanted` has and reads them back; notes() then has the new differences.
  void apply(const SensorValues& wanted);

  /// Waits for a frame; the stream that has one.
  Ready wait(std::chrono::milliseconds timeout);

  /// Reads the frame that wait() announced into `depth_mm` (0 = no reading) or `colour` (BGR, scaled to
  /// size() if the device has no such mode), reusing their memory. `time_us` is the device's clock, one for
  /// both. Fails if the frame cannot be used: too few bytes, cropped, another format.
  Outcome read_depth(cv::Mat1f& depth_mm, std::int64_t& time_us);
  Outcome read_colour(cv::Mat3b& colour, std::int64_t& time_us);

 private:
  struct Streams;
  void choose_modes(const std::optional<SensorMode>& wanted);
  void choose_colour_mode(const SensorMode& depth);
  void set_registration(bool on);
  void set_mirror(bool on);
  void set_camera(const SensorValues& wanted);
  void read_back();
  void note_differences(const SensorValues& wanted);
  void find_intrinsics();

  DeviceIdentity identity_;
  std::unique_ptr<Streams> streams_;
  cv::Size size_;
  int rate_hz_ = 0;
  std::vector<SensorMode> modes_;
  Intrinsics intrinsics_;
  SensorValues values_;
  std::vector<std::string> notes_;
  std::size_t opening_notes_ = 0;  // the first of notes_; the others are of the last apply()
};

}  // namespace saccade
