#include "attention/border_ownership.hpp"

namespace saccade {
namespace {

constexpr int kNoCell = -1;

}  // namespace

void BorderOwnership::measure(const SurfaceGrid& grid, const SurfaceSegments& segments) {
  const int rows = grid.rows(), cols = grid.cols();
  depth_mm_ = grid.depth_mm().data();
  segment_ = segments.of_cell().data();
  borders_.reserve(grid.size() / SurfaceSegments::kFewestCells);
  borders_.assign(static_cast<std::size_t>(segments.count()), {});
  above_.assign(static_cast<std::size_t>(cols), kNoCell);
  int i = 0;
  for (int r = 0; r < rows; ++r) {
    int left = kNoCell;
    for (int c = 0; c < cols; ++c, ++i) {
      if (depth_mm_[i] == 0) continue;
      const int links = grid.links()[static_cast<std::size_t>(i)];
      int& above = above_[static_cast<std::size_t>(c)];
      if (left != kNoCell)
        add_pair(left, i, 1, (links & SurfaceGrid::kLeft) != 0);
      else
        add_end(i);
      if (above != kNoCell)
        add_pair(above, i, cols, (links & SurfaceGrid::kUp) != 0);
      else
        add_end(i);
      left = above = i;
    }
    if (left != kNoCell) add_end(left);
  }
  for (const int last : above_)
    if (last != kNoCell) add_end(last);
}

// Nothing with depth follows on this side of cell i, up to the edge of the image.
void BorderOwnership::add_end(int i) {
  if (const int segment = segment_[i]; segment != SurfaceSegments::kNone)
    ++borders_[static_cast<std::size_t>(segment)].all;
}

// Cells i and j, `step` apart or a multiple of it, have no cell with depth between them. Links are those of
// neighbours only.
void BorderOwnership::add_pair(int i, int j, int step, bool linked) {
  if (segment_[i] == segment_[j]) return;
  const bool may_own = j - i <= (kWidestGap + 1) * step && !linked;
  add_side(i, j, may_own);
  add_side(j, i, may_own);
}

void BorderOwnership::add_side(int i, int j, bool may_own) {
  if (segment_[i] == SurfaceSegments::kNone) return;
  Border& border = borders_[static_cast<std::size_t>(segment_[i])];
  ++border.all;
  const float step = depth_mm_[j] - depth_mm_[i];
  if (may_own && step > SurfaceGrid::jump_mm(depth_mm_[i])) ++border.owned;
}

float BorderOwnership::front_share(int segment) const {
  const Border& border = borders_[static_cast<std::size_t>(segment)];
  return border.all > 0 ? static_cast<float>(border.owned) / static_cast<float>(border.all) : 0;
}

}  // namespace saccade
