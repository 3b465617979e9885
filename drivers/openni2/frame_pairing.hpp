#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <opencv2/core.hpp>

namespace saccade {

/// Pairs the depth and colour frames of one device by the device's clock. The colour of a depth frame is the
/// nearest colour frame that is at most half a period of depth away (16.7 ms at 30 Hz), so that it belongs to
/// no other depth frame. A depth frame waits for its colour until a later colour frame or the next depth
/// frame arrives, and then goes without.
///
/// The period is the mode's, or the shortest of the last 32 gaps between depth frames if that is less: a
/// device may be faster than its mode says. Not thread-safe.
class FramePairing {
 public:
  /// Forgets all frames, as for a device that was just opened. `period_us` is that of its depth mode.
  void restart(std::int64_t period_us, bool has_colour);

  /// Takes the image and leaves memory to use again in its place. A depth frame that still waits must be
  /// taken before the next one is put.
  void put_depth(cv::Mat1f& depth_mm, std::int64_t time_us);
  void put_colour(cv::Mat3b& colour, std::int64_t time_us);

  bool has_depth() const { return depth_us_.has_value(); }  ///< a depth frame waits
  bool is_ripe() const;  ///< it has its colour, or need not wait for it any longer

  struct Taken {
    std::int64_t time_us = 0;    ///< of depth
    bool colour_missed = false;  ///< the device has colour, but none came for this frame
  };
  /// Gives the depth frame that waits and its colour, empty if there is none, in exchange for what was there.
  /// Throws std::bad_optional_access if none waits.
  Taken take(cv::Mat1f& depth_mm, cv::Mat3b& colour);

 private:
  struct TimedColour {
    cv::Mat3b image;
    std::optional<std::int64_t> time_us;  // empty = no image
  };

  std::int64_t period_us() const;
  int colour_of_depth() const;

  bool has_colour_ = false;
  std::int64_t mode_period_us_ = 0;
  std::array<std::int64_t, 32> gaps_us_{};
  std::size_t next_gap_ = 0;
  cv::Mat1f depth_mm_;
  std::optional<std::int64_t> depth_us_, last_depth_us_;  // of the one that waits; of the one before
  std::array<TimedColour, 2> colours_;
  std::size_t newest_ = 0;
};

}  // namespace saccade
