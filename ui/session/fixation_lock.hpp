#pragma once

#include <optional>
#include <vector>

#include "attention/attention.hpp"

namespace saccade {

/// The fixation that the user has locked; it is found again in later frames and after other settings.
class FixationLock {
 public:
  void lock(const Fixation& fixation) { last_ = fixation; }
  void unlock() { last_.reset(); }
  bool locked() const { return last_.has_value(); }

  /// The index of the locked fixation among those of a frame: the one with its id or, frame by
  /// frame, the nearest within kNearest_mm, or within kNearest_px where one of both has no depth; -1 = it is
  /// not there. Follows it from frame to frame.
  int find(const std::vector<Fixation>& fixations);

  static constexpr double kNearest_mm = 120, kNearest_px = 24;

 private:
  std::optional<Fixation> last_;  // as it was found last
};

}  // namespace saccade
