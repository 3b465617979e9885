#include "sources/colour_video.hpp"

#include <cmath>
#include <cstdlib>
#include <mutex>
#include <utility>

#include <opencv2/core/utils/logger.hpp>

#include "core/error.hpp"
#include "sources/video_file.hpp"

namespace saccade {

void quieten_video_libraries() {
  static std::once_flag once;
  std::call_once(once, [] {
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
    const std::string options = std::string("format_whitelist;") + kVideoFormats + "|protocol_whitelist;file";
    ::setenv("OPENCV_FFMPEG_CAPTURE_OPTIONS", options.c_str(), 1);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  });
}

ColourVideo::ColourVideo(std::string name, double rate_hz) : name_(std::move(name)), rate_hz_(rate_hz) {
  quieten_video_libraries();
  open();
  if (ahead_.empty())
    throw unreadable("no image in this video can be read", name_, "the file may be truncated or not a video");
  const double rate = capture_.get(cv::CAP_PROP_FPS);
  if (std::isfinite(rate) && rate > 0) rate_hz_ = rate;
}

void ColourVideo::open() {
  capture_ = cv::VideoCapture(name_, cv::CAP_FFMPEG);
  count_ = 0;
  now_.release();
  ahead_.release();
  advance();
}

void ColourVideo::advance() {
  std::swap(now_, ahead_);
  now_us_ = ahead_us_;
  if (!capture_.read(ahead_) || ahead_.type() != CV_8UC3) {
    ahead_.release();
    return;
  }
  const double nominal_us = static_cast<double>(count_++) * 1e6 / rate_hz_;
  const double container_us = 1000 * capture_.get(cv::CAP_PROP_POS_MSEC);
  ahead_us_ = std::llround(container_us > 0 ? container_us : nominal_us);
}

bool ColourVideo::read(cv::Mat3b& image, std::int64_t& time_us) {
  if (ahead_.empty()) return false;
  ahead_.copyTo(image);
  time_us = ahead_us_;
  advance();
  return true;
}

bool ColourVideo::skip() {
  if (ahead_.empty()) return false;
  advance();
  return true;
}

bool ColourVideo::nearest(std::int64_t time_us, std::int64_t tolerance_us, cv::Mat3b& image) {
  if (!now_.empty() && time_us < now_us_) open();
  while (!ahead_.empty() && (now_.empty() || std::abs(ahead_us_ - time_us) <= std::abs(now_us_ - time_us)))
    advance();
  if (now_.empty() || std::abs(now_us_ - time_us) > tolerance_us) return false;
  now_.copyTo(image);
  return true;
}

}  // namespace saccade
