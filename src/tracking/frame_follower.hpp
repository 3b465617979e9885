#pragma once

#include "attention/frame_surfaces.hpp"
#include "core/background_job.hpp"
#include "core/frame.hpp"
#include "tracking/camera_motion.hpp"

namespace saccade {

/// What AttentionTracker needs of a frame and its saliency map does not: surfaces and camera motion, computed
/// on a thread of its own while the map is computed. The result depends on the frames alone. Thread safety:
/// one thread calls.
class FrameFollower {
 public:
  /// After a longer time without a frame, the scene may be another one: the sensor was away.
  static constexpr double kGap_s = 1;

  FrameFollower();

  /// Starts on the next frame, which must stay as it is until wait(). A frame whose index or time does not
  /// follow those of the last one is a cut, and so is one before which the source has `jumped`.
  void start(const Frame& frame, bool jumped = false);

  /// Waits until the frame is done. Rethrows what OpenCV threw.
  void wait() { job_.wait(); }

  // Of the frame that was waited for
  const FrameSurfaces& surfaces() const { return surfaces_; }
  const CameraStep& step() const { return step_; }

 private:
  void follow();

  const Frame* frame_ = nullptr;  // of the present job
  std::int64_t last_index_ = -1, last_us_ = 0;
  bool after_gap_ = false;  // the present job's frame came after a gap
  FrameSurfaces surfaces_;
  CameraMotion motion_;
  CameraStep step_;
  BackgroundJob job_;  // last: ends before the rest
};

}  // namespace saccade
