#include "drivers/openni2/frame_pairing.hpp"

#include <algorithm>
#include <cstdlib>

namespace saccade {

void FramePairing::restart(std::int64_t period_us, bool has_colour) {
  has_colour_ = has_colour;
  mode_period_us_ = period_us;
  gaps_us_.fill(period_us);
  depth_us_.reset();
  last_depth_us_.reset();
  for (TimedColour& colour : colours_) colour.time_us.reset();
}

void FramePairing::put_depth(cv::Mat1f& depth_mm, std::int64_t time_us) {
  cv::swap(depth_mm, depth_mm_);
  depth_us_ = time_us;
  if (last_depth_us_ && time_us > *last_depth_us_) {
    gaps_us_[next_gap_] = time_us - *last_depth_us_;
    next_gap_ = (next_gap_ + 1) % gaps_us_.size();
  }
  last_depth_us_ = time_us;
}

std::int64_t FramePairing::period_us() const {
  return std::min(mode_period_us_, *std::min_element(gaps_us_.begin(), gaps_us_.end()));
}

void FramePairing::put_colour(cv::Mat3b& colour, std::int64_t time_us) {
  newest_ = 1 - newest_;
  cv::swap(colour, colours_[newest_].image);
  colours_[newest_].time_us = time_us;
}

int FramePairing::colour_of_depth() const {
  int best = -1;
  std::int64_t least_us = period_us() / 2;
  for (std::size_t i = 0; i < colours_.size(); ++i) {
    if (!colours_[i].time_us) continue;
    const std::int64_t apart_us = std::abs(*colours_[i].time_us - *depth_us_);
    if (apart_us > least_us) continue;
    best = static_cast<int>(i);
    least_us = apart_us;
  }
  return best;
}

bool FramePairing::is_ripe() const {
  if (!depth_us_) return false;
  if (!has_colour_ || colour_of_depth() >= 0) return true;
  const auto& newest_us = colours_[newest_].time_us;
  return newest_us && *newest_us > *depth_us_;
}

FramePairing::Taken FramePairing::take(cv::Mat1f& depth_mm, cv::Mat3b& colour) {
  const int found = has_depth() ? colour_of_depth() : -1;
  const Taken taken{depth_us_.value(), has_colour_ && found < 0};
  cv::swap(depth_mm, depth_mm_);
  depth_us_.reset();
  if (found >= 0) {
    TimedColour& its = colours_[static_cast<std::size_t>(found)];
    cv::swap(colour, its.image);
    its.time_us.reset();
  } else {
    colour.release();
  }
  return taken;
}

}  // namespace saccade
