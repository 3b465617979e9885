#include "sources/colour_video.hpp"

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace saccade {

ColourVideo::ColourVideo(std::unique_ptr<VideoFile> file) : path_(file->path()), title_(file->title()) {
  open(std::move(file));
}

void ColourVideo::reopen() { open(std::make_unique<VideoFile>(path_, title_)); }

void ColourVideo::open(std::unique_ptr<VideoFile> file) {
  constexpr std::size_t kMostTried = 10'000;
  decoder_ = std::make_unique<ColourDecoder>(std::move(file));
  first_.clear();
  now_.reset();
  ahead_.reset();
  searching_ = false;
  while (first_.empty() || !first_.back().problem.empty()) {
    auto picture = first_.size() < kMostTried ? decoder_->next() : std::nullopt;
    if (!picture)
      throw unreadable("no image in this video can be read" +
                           (first_.empty() ? std::string() : "; the first: " + first_.front().problem),
                       path_.string(), "the file may be truncated or not a video");
    first_.push_back(std::move(*picture));
  }
  size_ = first_.back().image.size();
}

std::optional<ColourPicture> ColourVideo::next() {
  if (first_.empty()) return decoder_->next();
  ColourPicture picture = std::move(first_.front());
  first_.pop_front();
  return picture;
}

bool ColourVideo::read(cv::Mat3b& image, std::int64_t& time_us) {
  auto picture = next();
  if (!picture) return false;
  time_us = picture->time_us;
  if (!picture->problem.empty()) throw std::runtime_error(picture->problem);
  image = picture->image;
  return true;
}

bool ColourVideo::skip() { return next().has_value(); }

void ColourVideo::advance() {
  now_ = std::exchange(ahead_, std::nullopt);
  while ((ahead_ = next()) && !ahead_->problem.empty()) {
  }
}

bool ColourVideo::nearest(std::int64_t time_us, std::int64_t tolerance_us, cv::Mat3b& image) {
  if (now_ && time_us < now_->time_us) reopen();
  if (!std::exchange(searching_, true)) advance();
  while (ahead_ && (!now_ || std::abs(ahead_->time_us - time_us) <= std::abs(now_->time_us - time_us)))
    advance();
  if (!now_ || std::abs(now_->time_us - time_us) > tolerance_us) return false;
  now_->image.copyTo(image);
  return true;
}

}  // namespace saccade
