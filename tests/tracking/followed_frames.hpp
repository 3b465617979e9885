#pragma once

#include <opencv2/core.hpp>

#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"

namespace saccade {

/// What a tracker of all objects makes of frames at 30 Hz whose saliency is given.
class FollowedFrames {
 public:
  explicit FollowedFrames(int fixations = 10) : tracker_(fixations, 0, {}) { cv::setNumThreads(1); }

  /// The attention of the frame, which becomes the next one.
  const Attention& attend(Frame& frame, const cv::Mat1f& saliency) {
    follower_.start(frame);
    follower_.wait();
    tracker_.attend(frame, saliency, follower_.surfaces(), follower_.step(), attention_);
    ++frame.index;
    frame.timestamp_us += 33'000;
    return attention_;
  }

 private:
  FrameFollower follower_;
  AttentionTracker tracker_;
  Attention attention_;
};

}  // namespace saccade
