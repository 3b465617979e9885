#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"

namespace saccade {

/// What one frame of a sequence contributes to the measures over time.
struct WatchedFrame {
  /// A fixation with the id of its object.
  struct Point {
    int id = 0;
    int label = 0;            ///< of the object that it hits; 0 = none
    cv::Point3d position_mm;  ///< camera frame; z = 0: no reading there
  };
  std::vector<Point> points;  ///< in the order of attention
  std::vector<int> labels;    ///< of the objects in view, ascending
  /// Of each of these objects: the index of the point whose mask covers more than half of its pixels; -1 =
  /// none. Empty = not known.
  std::vector<int> covered_by;
  std::optional<cv::Affine3d> camera_to_world{};  ///< the true pose, mm
  Intrinsics camera{};
  cv::Size size{};
};

/// Labels with fewer pixels than this are not in view.
constexpr int kFewestPixels = 150;

/// Takes what is measured from a frame and the attention in it.
[[nodiscard]] WatchedFrame watched_frame(const Frame& frame, const Attention& attention);

/// What became of an object, or of all, in the frames in which it is in view; counts.
struct IdentityCounts {
  int in_view = 0;      ///< frames (of all objects: pairs of object and frame)
  int right = 0;        ///< with a point under the id that is best assigned to the object
  int other_id = 0;     ///< with points, but none under that id
  int in_other = 0;     ///< without a point; most of it in the mask of a point on something else
  int without = 0;      ///< without a point, and not in such a mask
  int more_points = 0;  ///< points on it beside the one that is counted above
  IdentityCounts& operator+=(const IdentityCounts& other);
};

/// How attention holds over a sequence.
struct OverTime {
  static constexpr std::array<int, 4> kFirst = {1, 3, 5, 10};
  static constexpr int kLag = 30;  ///< frames of held_later
  static constexpr double kSamePlace_mm = 80;

  /// Of the kFirst[i] first fixations of a frame whose place is in view in the next frame (in kLag frames),
  /// the share that this frame reports under the same id at that place; the mean over the frames. Places are
  /// known by the true poses; none without them, or if the sequence is too short.
  std::array<std::optional<double>, 4> held_next, held_later;

  /// Share of the frames whose first fixation has the id of that of the frame before; none below two frames.
  std::optional<double> first_stays;

  /// Ids that were among the first ten in at least five frames, over the number of different places they
  /// stood at; none without true poses.
  std::optional<double> ids_per_place;

  /// Agreement of ids with labels, which keep their identity: 2 TP / (fixations + objects in view), where TP
  /// counts the fixations that hit their object under the best one-to-one assignment of ids to labels.
  /// identity_f1 counts the fixations on labelled objects; identity_f1_all counts all, so those on other
  /// things as errors. None without labels.
  std::optional<double> identity_f1, identity_f1_all;
  /// identity_f1 if ids were perfect: an object that has points in a frame has one under its own id. What is
  /// missing to 1 is lost by the choice of points, what lies between it and identity_f1 by their ids.
  std::optional<double> best_identity_f1;
  /// Where identity_f1 is lost, by label, and the points on no object.
  std::map<int, IdentityCounts> of_label;
  int points_on_nothing = 0;
  /// How often an object was hit under other ids than the last time.
  int id_switches = 0;
};

/// OverTime::best_identity_f1 of frames whose ids need not be known; none if no object is in view.
[[nodiscard]] std::optional<double> best_identity_f1(const std::vector<WatchedFrame>& frames);

[[nodiscard]] OverTime measure_over_time(const std::vector<WatchedFrame>& frames);

/// The assignment of rows to columns, one to one, with the largest sum of gains (all >= 0). Gives the column
/// of each row, -1 = none.
[[nodiscard]] std::vector<int> best_assignment(const cv::Mat1d& gain);

}  // namespace saccade
