#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// How much of an object a frame shows.
enum class Sight {
  visible,  ///< enough of its surface is seen where it was
  hidden,   ///< something is before it, it is out of view, or there are no readings
  empty,    ///< its place is seen, and it is not there
};

/// Where the point of an object falls in a frame.
enum class AnchorSight {
  visible,
  hidden,  ///< behind something, or without a reading
  out_of_view,
  off,  ///< a surface behind it is seen there: the point is no longer on the object
};

/// An object of attention as it is remembered. Places are in the world, mm.
struct TrackedObject {
  bool alive = false;
  int id = 0;     ///< 0 = a candidate, which has not been chosen often enough to be reported
  int thing = 0;  ///< id of the object that is reported for the thing that it is a part of; mostly its own

  cv::Point3d anchor_mm;                ///< the point that attention rests on
  std::optional<cv::Point3d> home_mm;   ///< the anchor that went out of view, for a while
  std::vector<cv::Point3d> surface_mm;  ///< some points of its surface as it was last seen
  cv::Point3d centroid_mm;              ///< mean of all of them
  double area_mm2 = 0;                  ///< of its surface, as the camera saw it

  std::int64_t first_seen_us = 0, last_reported_us = 0;
  int frames_seen = 0;
  int times_chosen = 0;  ///< for itself, not as a part
  int rank = 0;          ///< in the order of attention, 0 = first, as of the last frame
  float strength = 0;    ///< value with which it was last chosen
  float confidence = 0;  ///< as reported; follows its mean only if that differs by a margin
  float mean_confidence = 0;
  float mean_saliency = 0;  ///< over time, of the map at its strongest place
  int times_judged = 0;     ///< over how many frames these means go
  bool member = false;      ///< was in the order when it was last visible, and has not been away for long
  bool appeared = false;    ///< came into a place that was seen without it

  // How long something has spoken for a change that is made only if it persists
  int frames_missed = 0;      ///< of a candidate: in which it was not chosen, in a row
  int frames_empty = 0;       ///< in a row
  double other_shape_s = 0;   ///< the segmentation disagrees with its cells
  double other_anchor_s = 0;  ///< another point of it is better, or its own is hidden
  double at_border_s = 0;     ///< its anchor is at its border; time inside takes back as much
  double from_home_s = 0;     ///< another point stands in for the one that went out of view

  // In the present frame
  Sight sight = Sight::hidden;
  AnchorSight anchor_sight = AnchorSight::hidden;
  int anchor_cell = -1;         ///< where the anchor is seen; -1 = it is not
  std::vector<int> seen_cells;  ///< where points of its surface are seen
  std::vector<int> cells;       ///< its own
  int segment = -1;             ///< that its cells are; -1 = they are carried along
  bool disc = false;            ///< it has no segment: its cells are a disc around the anchor
  bool chosen = false;          ///< has its place in the order
  float evidence = 0;           ///< largest value of its cells
  bool passed_over = false;     ///< gave its place in the order to another one
  int point_cell = -1;          ///< where its point is seen: the anchor's cell, or one that stands in for it

  /// Another object is reported for it.
  bool is_part() const { return thing != id; }

  /// How long ago it was last reported, itself or as a part.
  double unreported_s(std::int64_t time_us) const {
    return static_cast<double>(time_us - last_reported_us) * 1e-6;
  }

  /// The side of a square of its area.
  double size_mm() const { return std::sqrt(area_mm2); }
};

}  // namespace saccade
