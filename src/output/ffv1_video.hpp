#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include <opencv2/core.hpp>

namespace saccade {

/// Writes images as an FFV1 video in Matroska, without loss: each a key frame with checksums, so that damage
/// costs the damaged image only. The times of Matroska are in ms; equal or decreasing ones are moved 1 ms
/// behind the one before. The same images and times give the same bytes, for any number of processors. The
/// file is complete after finish(); without it, it has all images but for the last few. Not for several
/// threads at once.
class Ffv1Video {
 public:
  enum class Pixels { grey16, bgr8 };

  /// Creates or replaces the file. `rate_hz` (> 0): nominal. Throws Error (failed).
  Ffv1Video(const std::filesystem::path& path, cv::Size size, Pixels pixels, double rate_hz);
  ~Ffv1Video();
  Ffv1Video(const Ffv1Video&) = delete;
  Ffv1Video& operator=(const Ffv1Video&) = delete;

  /// Adds an image of the video's size, CV_16UC1 or CV_8UC3 (BGR), at `time_us` from the first. Throws Error
  /// (failed), e.g. for a full disk.
  void write(const cv::Mat& image, std::int64_t time_us);

  /// Writes the end of the file. Throws Error (failed).
  void finish();

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace saccade
