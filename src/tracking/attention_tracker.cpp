#include "tracking/attention_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "attention/proto.hpp"
#include "attention/selector.hpp"
#include "tracking/cell_projection.hpp"

namespace saccade {
namespace {

bool leaves_view(const TrackedObject& object, const SurfaceGrid& grid) {
  return std::any_of(object.cells.begin(), object.cells.end(), [&](int cell) {
    const int row = cell / grid.cols(), col = cell % grid.cols();
    return row == 0 || col == 0 || row + 1 == grid.rows() || col + 1 == grid.cols();
  });
}

}  // namespace

AttentionTracker::AttentionTracker(int fixations, double min_confidence, const TrackingSettings& settings)
    : objects_(settings.memory_s), gaze_({settings.dwell_s, settings.return_after_s}) {
  configure(fixations, min_confidence, settings);
}

void AttentionTracker::configure(int fixations, double min_confidence, const TrackingSettings& settings) {
  if (fixations < 1) throw std::invalid_argument("AttentionTracker: at least one fixation");
  fixations_ = fixations;
  min_confidence_ = min_confidence;
  objects_.set_memory(settings.memory_s);
  gaze_.set_timing({settings.dwell_s, settings.return_after_s});
}

void AttentionTracker::forget_evidence() {
  memory_.forget_means();
  for (TrackedObject& object : objects_.slots()) object.times_judged = 0;
}

void AttentionTracker::attend(const Frame& frame, const cv::Mat1f& saliency, const FrameSurfaces& surfaces,
                              const CameraStep& step, Attention& attention) {
  const SurfaceGrid& grid = surfaces.grid();
  begin_attention(saliency, frame.depth_mm, frame.intrinsics, attention);
  if (step.cut) {
    memory_.clear();
    objects_.clear();
    merging_.clear();
    parts_.clear();
    gaze_.clear();
    last_us_.reset();
  }
  const bool first = !last_us_;
  const double seconds = first ? 0 : static_cast<double>(frame.timestamp_us - *last_us_) * 1e-6;
  last_us_ = frame.timestamp_us;
  segments_ = surfaces.segments();
  if (!first) patches_.cut(grid, frame.colour, segments_);

  // Evidence over time
  smooth_cells(saliency, scratch_, smooth_);
  values_ = smooth_;
  surfaces.weigh(values_);
  memory_.carry(grid, step.to_previous);
  memory_.learn(values_, seconds);

  // Objects
  const cv::Affine3d from_world = inverse(step.to_world);
  objects_.correct(step.world_correction);
  objects_.predict(grid, from_world);
  shapes_.claim(grid, segments_, step.to_world, seconds, objects_, memory_);
  merging_.merge(grid, segments_, seconds, objects_, memory_);
  parts_.find(grid, segments_, frame.colour, seconds, objects_);

  // Order
  proto_objects_.begin(grid, segments_, frame.depth_mm, frame.intrinsics);
  const AttentionOrder::View view{frame,         saliency,   grid,    segments_,
                                  step.to_world, from_world, seconds, first};
  const int next_id = objects_.next_id();
  chosen_ = order_.choose(view, fixations_, shapes_, proto_objects_, objects_, memory_);
  const bool nothing_left = static_cast<int>(chosen_.size()) < fixations_;
  if (!first && objects_.next_id() != next_id) leave_new_parts_out(frame, grid);
  objects_.learn(grid, step.to_world);
  judge(view, surfaces);
  report(view, attention);
  if (nothing_left) attention.ended_early = chosen_.empty() ? kNothingSalient : kNothingLeft;
  if (const auto doubtful = static_cast<int>(chosen_.size() - reported_.size()); doubtful > 0)
    add_doubtful(doubtful, min_confidence_, attention.ended_early);

  attention.sequence = SequenceState{std::nullopt, step.cut, step.to_world};
  look(frame.timestamp_us, reported_, *attention.sequence);
  objects_.forget(frame.timestamp_us, memory_.owner());
}

// What has just got its id may be a part of something: then it is never reported.
void AttentionTracker::leave_new_parts_out(const Frame& frame, const SurfaceGrid& grid) {
  parts_.find(grid, segments_, frame.colour, 0, objects_);
  std::erase_if(chosen_, [&](std::size_t slot) { return objects_.slots()[slot].is_part(); });
}

// The mean saliency goes over the same time as the evidence; that of the confidence goes over more, since
// what an object is does not change. What the edge of the image cuts shows less of its border, which is no
// reason to doubt it.
void AttentionTracker::judge(const AttentionOrder::View& view, const FrameSurfaces& surfaces) {
  // The cell that would win alone, as the saliency of proto is relative to its first. That of the first
  // object is no measure, since its point stays where it is while the map changes.
  const auto winner = std::max_element(memory_.mean().begin(), memory_.mean().end());
  const float strongest = smooth_[static_cast<std::size_t>(winner - memory_.mean().begin())];
  const auto least = static_cast<float>(SurfaceMemory::share_of(view.seconds)),
             least_sure = static_cast<float>(SurfaceMemory::share_of(view.seconds, kConfidence_s));
  for (const std::size_t slot : chosen_) {
    TrackedObject& object = objects_.slots()[slot];
    const float saliency = smooth_[static_cast<std::size_t>(object.point_cell)];
    const float relative = strongest > 0 ? saliency / strongest : 1;
    const float share = 1 / static_cast<float>(++object.times_judged);
    object.mean_saliency += std::max(share, least) * (saliency_of(view, object) - object.mean_saliency);
    const float confidence = surfaces.confidence_at(object.point_cell, relative);
    if (object.times_judged == 1 || confidence > object.mean_confidence || !leaves_view(object, view.grid))
      object.mean_confidence += std::max(share, least_sure) * (confidence - object.mean_confidence);
    if (object.times_judged == 1 || std::abs(object.mean_confidence - object.confidence) > kConfidenceMargin)
      object.confidence = confidence_to_report(object);
  }
}

// What was sure enough to be reported stays so until its mean is more than the margin below the threshold.
float AttentionTracker::confidence_to_report(const TrackedObject& object) const {
  const auto least = static_cast<float>(min_confidence_);
  const bool was_sure = object.times_judged > 1 && object.confidence >= least;
  return was_sure && object.mean_confidence >= least - kConfidenceMargin
             ? std::max(object.mean_confidence, least)
             : object.mean_confidence;
}

// The map at the strongest cell of the object; in the first frame that is the cell that has won.
float AttentionTracker::saliency_of(const AttentionOrder::View& view, const TrackedObject& object) const {
  int strongest = object.point_cell;
  const auto evidence = [&](int cell) { return memory_.mean()[static_cast<std::size_t>(cell)]; };
  if (!view.first)
    for (const int cell : object.cells)
      if (evidence(cell) > evidence(strongest)) strongest = cell;
  return view.saliency(proto_objects_.fixated_pixel(view.saliency, strongest));
}

void AttentionTracker::report(const AttentionOrder::View& view, Attention& attention) {
  const Frame& frame = view.frame;
  reported_.clear();
  for (const std::size_t slot : chosen_) {
    const TrackedObject& object = objects_.slots()[slot];
    if (object.confidence < static_cast<float>(min_confidence_)) continue;
    reported_.push_back(slot);
    const cv::Point pixel = point_of(view, object);
    Fixation fixation = fixation_at(view.saliency, frame.depth_mm, frame.intrinsics, pixel.y, pixel.x);
    const int rank = static_cast<int>(attention.fixations.size()) + 1;
    fixation.proto_object = proto_objects_.paint(cells_of_thing(object), attention.masks, rank);
    fixation.saliency = object.mean_saliency;
    fixation.confidence = object.confidence;
    fixation.id = object.id;
    fixation.age_frames = object.frames_seen;
    fixation.world_mm = view.to_world * cv::Point3d(fixation.position_mm);
    attention.fixations.push_back(fixation);
  }
}

// The cells of an object and of all parts of the thing that it is reported for.
const std::vector<int>& AttentionTracker::cells_of_thing(const TrackedObject& object) {
  thing_cells_.reserve(memory_.owner().size());
  thing_cells_ = object.cells;
  for (const TrackedObject& other : objects_.slots())
    if (other.alive && other.is_part() && other.thing == object.id)
      thing_cells_.insert(thing_cells_.end(), other.cells.begin(), other.cells.end());
  return thing_cells_;
}

// The pixel of the object's anchor: the nearest with its depth, rather one that has the object on all four
// sides, since noise moves the object's border. Where the anchor is hidden, a pixel of the cell that stands
// in.
cv::Point AttentionTracker::point_of(const AttentionOrder::View& view, const TrackedObject& object) const {
  const cv::Point3d anchor = view.from_world * object.anchor_mm;
  const Intrinsics& camera = view.frame.intrinsics;
  const cv::Mat1f& depth = view.frame.depth_mm;
  cv::Point best(-1, -1), inside(-1, -1);
  if (object.anchor_sight == AnchorSight::visible) {
    constexpr int kReach = 2 * SurfaceGrid::kCellPx;
    const int row = cvRound(camera.fy * anchor.y / anchor.z + camera.cy),
              col = cvRound(camera.fx * anchor.x / anchor.z + camera.cx);
    int nearest = kReach * kReach + 1, nearest_inside = nearest;
    for (int r = std::max(0, row - kReach); r <= std::min(depth.rows - 1, row + kReach); ++r)
      for (int c = std::max(0, col - kReach); c <= std::min(depth.cols - 1, col + kReach); ++c) {
        const int away = (r - row) * (r - row) + (c - col) * (c - col);
        if (away >= nearest_inside || compare_depth(depth(r, c), anchor.z) != Seen::same) continue;
        if (away < nearest) {
          nearest = away;
          best = {c, r};
        }
        if (!view.first && is_inside(view, object, anchor.z, {c, r})) {  // the first frame is that of proto
          nearest_inside = away;
          inside = {c, r};
        }
      }
  }
  if (inside.x >= 0) return inside;
  return best.x >= 0 ? best : proto_objects_.fixated_pixel(view.saliency, object.point_cell);
}

// Whether the pixels kInside_px away on all four sides have the depth, and are in cells of the object.
bool AttentionTracker::is_inside(const AttentionOrder::View& view, const TrackedObject& object,
                                 double depth_mm, cv::Point pixel) const {
  const int own = objects_.owner_of(object);
  const cv::Mat1f& depth = view.frame.depth_mm;
  const auto is_own = [&](int right, int down) {
    const int row = pixel.y + down, col = pixel.x + right;
    if (row < 0 || col < 0 || row >= depth.rows || col >= depth.cols) return false;
    const int cell = row / SurfaceGrid::kCellPx * view.grid.cols() + col / SurfaceGrid::kCellPx;
    return memory_.owner()[static_cast<std::size_t>(cell)] == own &&
           compare_depth(depth(row, col), depth_mm) == Seen::same;
  };
  return is_own(-kInside_px, 0) && is_own(kInside_px, 0) && is_own(0, -kInside_px) && is_own(0, kInside_px);
}

void AttentionTracker::look(std::int64_t time_us, const std::vector<std::size_t>& chosen,
                            SequenceState& sequence) {
  targets_.clear();
  for (const std::size_t slot : chosen) {
    const TrackedObject& object = objects_.slots()[slot];
    targets_.push_back({object.id, object.strength, object.appeared});
  }
  sequence.gaze = gaze_.look(time_us, targets_);
}

}  // namespace saccade
