#include "attention/cells_of_segments.hpp"

#include <algorithm>

namespace saccade {

void CellsOfSegments::list(const SurfaceSegments& segments) {
  const std::vector<int>& of_cell = segments.of_cell();
  first_.assign(at(segments.count() + 2), 0);
  for (const int segment : of_cell) ++first_[at(segment + 1)];
  int sum = 0;
  for (int& first : first_) {
    const int cells = first;
    first = sum;
    sum += cells;
  }
  cells_.resize(of_cell.size());
  for (int i = 0; i < static_cast<int>(of_cell.size()); ++i) cells_[at(first_[at(of_cell[at(i)] + 1)]++)] = i;
  // Each entry has moved to the end of its segment, which is the beginning of the next.
  std::move_backward(first_.begin(), first_.end() - 1, first_.end());
  first_[0] = 0;
}

std::span<const int> CellsOfSegments::of(int segment) const {
  const std::size_t first = at(first_[at(segment + 1)]), end = at(first_[at(segment + 2)]);
  return std::span(cells_).subspan(first, end - first);
}

}  // namespace saccade
