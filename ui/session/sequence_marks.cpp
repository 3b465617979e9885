#include "ui/session/sequence_marks.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr double kRemembered_s = 60;

double seconds(std::int64_t from_us, std::int64_t to_us) {
  return static_cast<double>(to_us - from_us) * 1e-6;
}

std::optional<cv::Point2d> seen_at(const cv::Point3d& world_mm, const cv::Affine3d& from_world,
                                   const Intrinsics& camera) {
  const cv::Point3d p = from_world * world_mm;
  if (!(p.z > 0)) return std::nullopt;
  return cv::Point2d(camera.fx * p.x / p.z + camera.cx + 0.5, camera.fy * p.y / p.z + camera.cy + 0.5);
}

}  // namespace

SequenceMarks MarkHistory::next(const Frame& frame, const Attention& attention, float largest, bool other_map,
                                double return_after_s) {
  const SequenceState& sequence = *attention.sequence;
  const std::int64_t time_us = frame.timestamp_us;
  if (sequence.cut) {
    objects_.clear();
    trail_.clear();
    last_us_.reset();
  }
  const double share = last_us_ && !other_map ? 1 - std::exp(-seconds(*last_us_, time_us) / kRange_s) : 1;
  range_high_ += static_cast<float>(share) * (largest - range_high_);
  for (const Fixation& fixation : attention.fixations) see(fixation, time_us);
  look(sequence, time_us);
  forget(time_us);
  last_us_ = time_us;

  SequenceMarks shown;
  shown.range_high = range_high_;
  const cv::Affine3d from_world = sequence.camera_to_world.inv();
  for (const Fixation& fixation : attention.fixations) {
    const Object& object = objects_.at(fixation.id);
    const bool attended = fixation.id != sequence.gaze && object.looked_us &&
                          seconds(*object.looked_us, time_us) < return_after_s;
    const cv::Point2d pixel(fixation.col + 0.5, fixation.row + 0.5);
    shown.marks.push_back({seen_at(object.world_mm, from_world, frame.intrinsics).value_or(pixel), attended,
                           object.looks, seconds(object.first_us, time_us), fixation.id});
  }
  for (const int id : trail_)
    if (const auto at = seen_at(objects_.at(id).world_mm, from_world, frame.intrinsics))
      shown.trail.push_back(*at);
  return shown;
}

void MarkHistory::see(const Fixation& fixation, std::int64_t time_us) {
  const cv::Point3d place(fixation.world_mm);
  const auto [found, fresh] = objects_.try_emplace(fixation.id);
  Object& object = found->second;
  if (fresh) object.first_us = time_us;
  const bool jump = fresh || cv::norm(place - object.world_mm) > kMoved_mm;
  const double share = jump ? 1 : 1 - std::exp(-seconds(object.last_us, time_us) / kSmooth_s);
  object.world_mm += share * (place - object.world_mm);
  object.last_us = time_us;
}

void MarkHistory::look(const SequenceState& sequence, std::int64_t time_us) {
  if (!sequence.gaze) return;
  Object& object = objects_.at(*sequence.gaze);
  object.looked_us = time_us;
  if (!trail_.empty() && trail_.back() == *sequence.gaze) return;
  ++object.looks;
  trail_.push_back(*sequence.gaze);
  if (trail_.size() > kTrail) trail_.pop_front();
}

// Keeps the state small over hours.
void MarkHistory::forget(std::int64_t time_us) {
  std::erase_if(objects_, [&](const auto& entry) {
    return seconds(entry.second.last_us, time_us) > kRemembered_s &&
           std::find(trail_.begin(), trail_.end(), entry.first) == trail_.end();
  });
}

}  // namespace saccade
