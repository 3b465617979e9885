#include "tracking/colour_patches.hpp"

#include <algorithm>

namespace saccade {
void ColourPatches::cut(const SurfaceGrid& grid, const cv::Mat3b& colour, SurfaceSegments& segments) {
  if (colour.empty()) return;
  colour_.reserve(grid.size());
  patch_.reserve(grid.size());
  cells_of_segments_.list(segments);
  measure_areas(grid, segments);
  state_.assign(grid.size(), State::none);
  const int count = segments.count();
  for (int segment = 0; segment < count; ++segment) {
    if (segments.is_supporting_plane(segment) || area_mm2_[at(segment)] < kLeastArea_mm2) continue;
    const std::span<const int> cells = cells_of_segments_.of(segment);
    if (!mark_others(grid, colour, cells)) continue;
    for (const int seed : cells) {
      if (state_[at(seed)] != State::other) continue;
      collect(grid, seed);
      if (!is_strip(grid)) segments.cut(patch_);
      for (const int cell : patch_) state_[at(cell)] = State::done;
    }
  }
}

void ColourPatches::measure_areas(const SurfaceGrid& grid, const SurfaceSegments& segments) {
  area_mm2_.assign(at(segments.count()), 0);
  const double per_square = 1 / (grid.camera().fx * grid.camera().fy);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const int segment = segments.of_cell()[i];
    if (segment == SurfaceSegments::kNone) continue;
    const double z = static_cast<double>(grid.depth_mm()[i]);
    area_mm2_[at(segment)] += z * z * per_square;
  }
}

// False if the segment has no colour of its own.
bool ColourPatches::mark_others(const SurfaceGrid& grid, const cv::Mat3b& colour,
                                std::span<const int> cells) {
  colour_.clear();
  for (const int cell : cells) colour_.push_back(chromaticity(grid, colour, cell));
  const auto own = own_colour_.find(colour_, kOwnShare);
  if (!own) return false;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (colour_[k][0] >= 0 && distance(colour_[k], *own) > kOtherColour) state_[at(cells[k])] = State::other;
  return true;
}

void ColourPatches::collect(const SurfaceGrid& grid, int seed) {
  const int cols = grid.cols();
  patch_.assign(1, seed);
  state_[at(seed)] = State::patch;
  const auto visit = [&](int cell) {
    if (state_[at(cell)] != State::other) return;
    state_[at(cell)] = State::patch;
    patch_.push_back(cell);
  };
  for (std::size_t next = 0; next < patch_.size(); ++next) {
    const int cell = patch_[next], row = cell / cols, col = cell % cols;
    if (row > 0) visit(cell - cols);
    if (row + 1 < grid.rows()) visit(cell + cols);
    if (col > 0) visit(cell - 1);
    if (col + 1 < cols) visit(cell + 1);
  }
}

// True if no cell has only cells of the patch within kReach.
bool ColourPatches::is_strip(const SurfaceGrid& grid) const {
  const int cols = grid.cols();
  return std::none_of(patch_.begin(), patch_.end(), [&](int cell) {
    const int row = cell / cols, col = cell % cols;
    if (row < kReach || col < kReach || row + kReach >= grid.rows() || col + kReach >= cols) return false;
    for (int v = -kReach; v <= kReach; ++v)
      for (int u = -kReach; u <= kReach; ++u)
        if (state_[at(cell + v * cols + u)] != State::patch) return false;
    return true;
  });
}

}  // namespace saccade
