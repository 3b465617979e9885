#include "tracking/frame_follower.hpp"

namespace saccade {

FrameFollower::FrameFollower() : job_([this] { follow(); }) {}

void FrameFollower::start(const Frame& frame, bool jumped) {
  if (jumped || frame.index <= last_index_ || frame.timestamp_us < last_us_) motion_.restart();
  after_gap_ = static_cast<double>(frame.timestamp_us - last_us_) > kGap_s * 1e6;
  last_index_ = frame.index;
  last_us_ = frame.timestamp_us;
  frame_ = &frame;
  job_.start();
}

void FrameFollower::follow() {
  surfaces_.build(frame_->depth_mm, frame_->intrinsics);
  step_ = motion_.follow(surfaces_.grid(), frame_->colour, after_gap_);
}

}  // namespace saccade
