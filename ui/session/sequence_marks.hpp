#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"

namespace saccade {

/// How the fixations of one frame of a sequence are shown.
struct SequenceMarks {
  struct Mark {
    cv::Point2d place;      ///< of its middle, pixels; (0, 0) is the corner of the first pixel
    bool attended = false;  ///< it was looked at, and the gaze may not return to it yet
    int looks = 0;          ///< how often the gaze has turned to it
    double age_s = 0;       ///< since it was first reported
    int id = 0;             ///< of its object in the memory of this side; Fixation::id is what is shown
  };
  std::vector<Mark> marks;         ///< one for each fixation, in their order
  std::vector<cv::Point2d> trail;  ///< where the gaze was, oldest first, up to where it is; pixels
  float range_high = 0;            ///< upper end of the map's colours, which follows the maps slowly
};

/// What the marks of a sequence need of the frames before. Places are smoothed in the world and not in the
/// image: noise does not shake the marks, and they do not lag behind when the camera moves. A copy goes on
/// from the same state.
class MarkHistory {
 public:
  static constexpr double kSmooth_s = 0.25;  ///< time constant of places
  static constexpr double kMoved_mm = 100;   ///< beyond this an object has moved, and its mark goes at once
  static constexpr double kRange_s = 2;      ///< time constant of the range of colours
  static constexpr std::size_t kTrail = 6;   ///< places of the trail

  /// The marks of the next frame, whose attention is that of a sequence. `largest`: of the smoothed map.
  /// other_map: it is of another model or other settings than the one before, so its range begins again.
  SequenceMarks next(const Frame& frame, const Attention& attention, float largest, bool other_map,
                     double return_after_s);

 private:
  struct Object {
    cv::Point3d world_mm;
    std::int64_t first_us = 0, last_us = 0;  // reported
    std::optional<std::int64_t> looked_us;   // the last time
    int looks = 0;
  };

  void see(const Fixation& fixation, std::int64_t time_us);
  void look(const SequenceState& sequence, std::int64_t time_us);
  void forget(std::int64_t time_us);

  std::map<int, Object> objects_;  // by id
  std::deque<int> trail_;          // ids, oldest first
  std::optional<std::int64_t> last_us_;
  float range_high_ = 0;
};

}  // namespace saccade
