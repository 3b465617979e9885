#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "sources/colour_decoder.hpp"

namespace saccade {

/// Colour images of a video file, in the order of their times.
class ColourVideo {
 public:
  /// Of a file from which nothing was taken. Throws Error (unreadable): no sound image, or of an unknown
  /// codec.
  explicit ColourVideo(std::unique_ptr<VideoFile> file);

  cv::Size size() const { return size_; }  ///< of the first sound image
  double rate_hz() const { return decoder_->rate_hz(); }

  /// Reads the next image (BGR) into `image`. False at the end. Throws std::runtime_error with the reason if
  /// this image is damaged or lost; the next may be good.
  [[nodiscard]] bool read(cv::Mat3b& image, std::int64_t& time_us);

  /// The sound image nearest to `time_us`, at most `tolerance_us` away; false if there is none. `time_us` may
  /// also decrease, which reads the video again from its start. Not to be mixed with read() and skip().
  [[nodiscard]] bool nearest(std::int64_t time_us, std::int64_t tolerance_us, cv::Mat3b& image);

  /// Skips an image. False at the end.
  [[nodiscard]] bool skip();

 private:
  void open(std::unique_ptr<VideoFile> file);
  void reopen();
  std::optional<ColourPicture> next();
  void advance();

  std::filesystem::path path_;
  std::string title_;
  std::unique_ptr<ColourDecoder> decoder_;
  cv::Size size_;
  std::deque<ColourPicture> first_;  // up to the first sound one, for as long as they have not been read
  // nearest() chooses between these two, of which ahead_ is the later one.
  std::optional<ColourPicture> now_, ahead_;
  bool searching_ = false;  // they are in use
};

}  // namespace saccade
