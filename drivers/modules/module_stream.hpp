#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include <Driver/OniDriverAPI.h>
#include <opencv2/core.hpp>

#include "drivers/modules/with_properties.hpp"

namespace saccade {

/// The kind of a driver module's stream.
struct StreamKind {
  OniSensorType sensor = ONI_SENSOR_DEPTH;
  std::vector<OniVideoMode> modes;  ///< the first is the one a new stream has
  int largest_value = 0;            ///< of depth: all readings are below it, else OpenNI's codecs drop them
};

/// Horizontal and vertical field of view in radians.
struct FieldOfView {
  double horizontal_rad = 0, vertical_rad = 0;
};

/// The settings of a client for its images, at one moment.
struct StreamSettings {
  OniVideoMode mode{};
  OniCropping cropping{};
  bool mirrored = false;
};

/// The common part of the driver modules' streams: the properties that OpenNI2 and its programs read, and
/// handing on an image mirrored and cropped as the client set it. The owner of the images derives from it, or
/// gives it functions to start and stop. Thread safety: OpenNI2 calls from any thread; deliver() runs on the
/// thread that makes the images, and stop() returns only when no deliver() is under way.
class ModuleStream : public WithProperties<oni::driver::StreamBase> {
 public:
  /// `running(true)` is called when a client starts the stream, and may refuse by false; `running(false)`
  /// when the client stops it.
  ModuleStream(StreamKind kind, const std::function<FieldOfView()>& field_of_view,
               std::function<bool(bool)> running);

  const StreamKind& kind() const { return kind_; }
  StreamSettings settings() const;
  bool started() const;

  /// Hands on an image of the mode's size, or does nothing if the stream is stopped or the mode has changed
  /// under way. CV_16UC1 (mm, 0 = no reading; or infrared) or CV_8UC3 (red first). `missing_bytes` makes the
  /// frame that many bytes shorter than its size.
  void deliver(const cv::Mat& image, int index, std::uint64_t timestamp_us, int missing_bytes = 0);

  OniStatus start() final;
  void stop() final;
  /// Room for the largest mode, since the mode may be changed after the buffers were made.
  int getRequiredFrameSize() final;
  /// Right for images that are registered already; the others have no calibration to do better.
  OniStatus convertDepthToColorCoordinates(StreamBase* colour, int depth_x, int depth_y, OniDepthPixel depth,
                                           int* colour_x, int* colour_y) final;

 private:
  OniStatus set_mode(const OniVideoMode& mode);
  OniStatus set_cropping(const OniCropping& cropping);
  bool exchange_started(bool started);
  int stride() const;
  void fill(OniFrame& out, const cv::Mat& image, const StreamSettings& settings) const;

  StreamKind kind_;
  std::function<bool(bool)> running_;
  mutable std::mutex settings_mutex_;
  StreamSettings settings_;    // guarded by settings_mutex_
  std::mutex delivery_mutex_;  // held while a frame is handed on
  bool started_ = false;       // guarded by settings_mutex_
};

/// Bytes of a pixel; 0 for formats that no module offers.
int bytes_per_pixel(OniPixelFormat format);

/// The modes of all `sizes` at all `rates`, sizes first.
std::vector<OniVideoMode> video_modes(OniPixelFormat format, const std::vector<cv::Size>& sizes,
                                      const std::vector<int>& rates);

}  // namespace saccade
