#pragma once

#include <span>
#include <vector>

#include "attention/surface_segments.hpp"

namespace saccade {

/// The cells of each segment. No allocation for a second frame of the same size with no more segments.
class CellsOfSegments {
 public:
  /// Lists the cells of the segments as they are now.
  void list(const SurfaceSegments& segments);

  /// The cells of a segment (or of kNone), in ascending order; valid until list().
  std::span<const int> of(int segment) const;

 private:
  // Sorted by segment: those of s begin at first_[s + 1], since kNone is -1.
  std::vector<int> first_, cells_;
};

}  // namespace saccade
