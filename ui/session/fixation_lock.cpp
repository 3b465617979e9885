#include "ui/session/fixation_lock.hpp"

#include <cmath>

namespace saccade {
namespace {

// Relative to the greatest distance that counts as the same; above 1 = another fixation.
double difference(const Fixation& a, const Fixation& b) {
  if (a.id != 0 && b.id != 0) {
    if (a.id != b.id) return 2;
    if (b.age_frames >= a.age_frames) return 0;  // else the sequence has begun again, and ids with it
  }
  if (a.position_mm.z > 0 && b.position_mm.z > 0)
    return cv::norm(a.position_mm - b.position_mm) / FixationLock::kNearest_mm;
  return std::hypot(a.row - b.row, a.col - b.col) / FixationLock::kNearest_px;
}

}  // namespace

int FixationLock::find(const std::vector<Fixation>& fixations) {
  if (!last_) return -1;
  int nearest = -1;
  double least = 1;
  for (int i = 0; i < static_cast<int>(fixations.size()); ++i) {
    const double distance = difference(*last_, fixations[static_cast<std::size_t>(i)]);
    if (distance > least) continue;
    least = distance;
    nearest = i;
  }
  if (nearest >= 0) last_ = fixations[static_cast<std::size_t>(nearest)];
  return nearest;
}

}  // namespace saccade
