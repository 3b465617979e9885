#pragma once

#include <cstdint>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

namespace saccade {

/// Keeps OpenCV's video libraries from writing to standard error, and from files that a video names:
/// playlists are no videos.
void quieten_video_libraries();

/// Colour images of a video file, in the order of their times.
class ColourVideo {
 public:
  /// `rate_hz`: where the file names none. Throws Error (unreadable) without a first image.
  ColourVideo(std::string name, double rate_hz);

  cv::Size size() const { return ahead_.size(); }
  double rate_hz() const { return rate_hz_; }

  /// Reads the next image (BGR) into `image`. False at the end.
  [[nodiscard]] bool read(cv::Mat3b& image, std::int64_t& time_us);

  /// The image nearest to `time_us`, at most `tolerance_us` away; false if there is none. `time_us` may also
  /// decrease, which reads the video again from its start.
  [[nodiscard]] bool nearest(std::int64_t time_us, std::int64_t tolerance_us, cv::Mat3b& image);

  /// Skips an image. False at the end.
  [[nodiscard]] bool skip();

 private:
  void open();
  void advance();

  std::string name_;
  double rate_hz_;
  cv::VideoCapture capture_;
  std::int64_t count_ = 0;  // images read
  // nearest() chooses between these two; ahead_ is the later one, empty at the end.
  cv::Mat now_, ahead_;
  std::int64_t now_us_ = 0, ahead_us_ = 0;
};

}  // namespace saccade
