#include "attention/surface_segments.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr double kPlaneShare = 0.15;          // of all cells with depth: the least size of a supporting plane
constexpr double kOffPlane = 0.018;           // of the depth: farther from the plane is another surface
constexpr int kUngrown = -2, kTooSmall = -3;  // in of_cell_ while it is made

// Calls visit(neighbour) for the cells that `i` is linked to: up, left, right, down.
template <typename Visit>
void for_linked(const SurfaceGrid& grid, int i, Visit visit) {
  const int links = grid.links()[static_cast<std::size_t>(i)];
  if (links & SurfaceGrid::kUp) visit(i - grid.cols());
  if (links & SurfaceGrid::kLeft) visit(i - 1);
  if (links & SurfaceGrid::kRight) visit(i + 1);
  if (links & SurfaceGrid::kDown) visit(i + grid.cols());
}

}  // namespace

void SurfaceSegments::grow(const SurfaceGrid& grid) {
  segments_.clear();
  segments_.reserve(grid.size() / kFewestCells);
  queue_.clear();
  queue_.reserve(grid.size());
  of_cell_.assign(grid.size(), kUngrown);
  grow_convex(grid);
  flood_edges(grid);
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (of_cell_[i] < 0) of_cell_[i] = grid.depth_mm()[i] > 0 ? kUngrown : kNone;
  grow_rest(grid);
  find_supporting_planes(grid);
}

void SurfaceSegments::grow_convex(const SurfaceGrid& grid) {
  const auto& convex = grid.convex();
  const int cells = static_cast<int>(grid.size());
  for (int seed = 0; seed < cells; ++seed) {
    if (of_cell_[static_cast<std::size_t>(seed)] != kUngrown || !convex[static_cast<std::size_t>(seed)])
      continue;
    const int segment = count();
    const std::size_t begin = queue_.size();
    queue_.push_back(seed);
    of_cell_[static_cast<std::size_t>(seed)] = segment;
    for (std::size_t next = begin; next < queue_.size(); ++next)
      for_linked(grid, queue_[next], [&](int j) {
        int& other = of_cell_[static_cast<std::size_t>(j)];
        if (other != kUngrown || !convex[static_cast<std::size_t>(j)]) return;
        other = segment;
        queue_.push_back(j);
      });
    const std::size_t grown = queue_.size() - begin;
    if (grown >= kFewestCells) {
      segments_.push_back({static_cast<int>(grown)});
      continue;
    }
    for (std::size_t k = begin; k < queue_.size(); ++k)
      of_cell_[static_cast<std::size_t>(queue_[k])] = kTooSmall;
    queue_.resize(begin);
  }
}

// Breadth first from all segments at once: an edge's cells go to the segment that is the fewest links away;
// ties go to the segment that was grown first.
void SurfaceSegments::flood_edges(const SurfaceGrid& grid) {
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const int segment = of_cell_[static_cast<std::size_t>(queue_[next])];
    for_linked(grid, queue_[next], [&](int j) {
      int& other = of_cell_[static_cast<std::size_t>(j)];
      if (other >= 0) return;
      other = segment;
      ++segments_[static_cast<std::size_t>(segment)].cells;
      queue_.push_back(j);
    });
  }
}

// The segments cut from a supporting plane are searched too: they may hold another one, a wall behind a
// floor.
void SurfaceSegments::find_supporting_planes(const SurfaceGrid& grid) {
  const auto valid =
      std::count_if(grid.depth_mm().begin(), grid.depth_mm().end(), [](float z) { return z > 0; });
  const double least = kPlaneShare * static_cast<double>(valid);
  cells_.reserve(grid.size());
  for (int segment = 0; segment < count(); ++segment) {
    const double cells = segments_[static_cast<std::size_t>(segment)].cells;
    if (cells < least) continue;
    cells_.clear();
    for (int i = 0; i < static_cast<int>(grid.size()); ++i)
      if (of_cell_[static_cast<std::size_t>(i)] == segment) cells_.push_back(i);
    const auto found = plane_search_.find(grid, cells_);
    if (!found || found->share * cells < least) continue;
    segments_[static_cast<std::size_t>(segment)].supporting_plane = true;
    cut_from_plane(grid, segment, found->plane);
  }
}

void SurfaceSegments::cut_from_plane(const SurfaceGrid& grid, int segment, const InversePlane& plane) {
  const float* w = grid.inverse_depth().data();
  int* of_cell = of_cell_.data();
  for (int row = 0; row < grid.rows(); ++row, of_cell += grid.cols(), w += grid.cols())
    for (int col = 0; col < grid.cols(); ++col) {
      const double inverse = static_cast<double>(w[col]);
      if (of_cell[col] == segment && std::abs(plane.at(row, col) - inverse) > kOffPlane * inverse)
        of_cell[col] = kUngrown;
    }
  grow_rest(grid);
}

// Makes segments of the ungrown cells by their links alone, concave or not: what has no convex part, like the
// inside of a bowl behind depth jumps.
void SurfaceSegments::grow_rest(const SurfaceGrid& grid) {
  const int cells = static_cast<int>(grid.size());
  for (int seed = 0; seed < cells; ++seed) {
    if (of_cell_[static_cast<std::size_t>(seed)] != kUngrown) continue;
    const int segment = count();
    queue_.assign(1, seed);
    of_cell_[static_cast<std::size_t>(seed)] = segment;
    for (std::size_t next = 0; next < queue_.size(); ++next)
      for_linked(grid, queue_[next], [&](int j) {
        int& other = of_cell_[static_cast<std::size_t>(j)];
        if (other != kUngrown) return;
        other = segment;
        queue_.push_back(j);
      });
    if (queue_.size() >= kFewestCells)
      segments_.push_back({static_cast<int>(queue_.size())});
    else
      for (int i : queue_) of_cell_[static_cast<std::size_t>(i)] = kNone;
  }
}

void SurfaceSegments::cut(const std::vector<int>& cells) {
  segments_.reserve(of_cell_.size() / kFewestCells);
  for (const int cell : cells) {
    int& segment = of_cell_[static_cast<std::size_t>(cell)];
    --segments_[static_cast<std::size_t>(segment)].cells;
    segment = count();
  }
  segments_.push_back({.cells = static_cast<int>(cells.size()), .cut = true});
}

}  // namespace saccade
