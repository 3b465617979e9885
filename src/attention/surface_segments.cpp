#include "attention/surface_segments.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr int kFewestCells = 6;          // of a segment
constexpr double kPlaneShare = 0.15;     // of all cells with depth: the least size of a supporting plane
constexpr double kPlaneInSegment = 0.5;  // the least part of its segment that a supporting plane takes
constexpr double kPlane = 0.012;       // of the depth: as far as a cell in the plane may be from it to fit it
constexpr double kPlaneRough = 0.036;  // the same while the plane is not yet known well
constexpr double kOffPlane = 0.018;    // of the depth: farther from the plane is another surface
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

double distance_from(const SurfaceSegments::Plane& plane, const SurfaceGrid& grid, int i) {
  const double w = static_cast<double>(grid.inverse_depth()[static_cast<std::size_t>(i)]);
  return std::abs(plane.a * (i % grid.cols()) + plane.b * (i / grid.cols()) + plane.c - w) / w;
}

}  // namespace

void SurfaceSegments::grow(const SurfaceGrid& grid) {
  cols_ = grid.cols();
  segments_.clear();
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
      segments_.push_back({static_cast<int>(grown), false});
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
  for (int segment = 0; segment < count(); ++segment) {
    const double cells = segments_[static_cast<std::size_t>(segment)].cells;
    if (cells < least) continue;
    Plane plane;
    const double in_plane = fit_plane(grid, segment, plane);
    if (in_plane < kPlaneInSegment || in_plane * cells < least) continue;
    segments_[static_cast<std::size_t>(segment)].supporting_plane = true;
    cut_from_plane(grid, segment, plane);
  }
}

// Least squares in inverse depth over every fourth cell of the segment, again on the cells near the plane so
// found. Gives the part of the segment that lies in it.
double SurfaceSegments::fit_plane(const SurfaceGrid& grid, int segment, Plane& plane) const {
  constexpr int kRounds = 6, kEvery = 2;
  double share = 0;
  for (int round = 0; round < kRounds; ++round) {
    const double reach = round == 1 ? kPlaneRough : kPlane;
    double all = 0, n = 0, su = 0, sv = 0, suu = 0, svv = 0, suv = 0, sw = 0, suw = 0, svw = 0;
    for (int r = 0; r < grid.rows(); r += kEvery)
      for (int c = 0; c < cols_; c += kEvery) {
        const int i = r * cols_ + c;
        if (of_cell_[static_cast<std::size_t>(i)] != segment) continue;
        all += 1;
        if (round > 0 && distance_from(plane, grid, i) > reach) continue;
        const double w = static_cast<double>(grid.inverse_depth()[static_cast<std::size_t>(i)]);
        n += 1, su += c, sv += r, suu += c * c, svv += r * r, suv += r * c;
        sw += w, suw += c * w, svw += r * w;
      }
    const double uu = n * suu - su * su, vv = n * svv - sv * sv, uv = n * suv - su * sv;
    const double determinant = uu * vv - uv * uv;
    if (n < 3 || determinant <= 0) return 0;
    const double uw = n * suw - su * sw, vw = n * svw - sv * sw;
    plane.a = (uw * vv - vw * uv) / determinant;
    plane.b = (vw * uu - uw * uv) / determinant;
    plane.c = (sw - plane.a * su - plane.b * sv) / n;
    share = n / all;
  }
  return share;
}

void SurfaceSegments::cut_from_plane(const SurfaceGrid& grid, int segment, const Plane& plane) {
  const int cells = static_cast<int>(grid.size());
  for (int i = 0; i < cells; ++i)
    if (of_cell_[static_cast<std::size_t>(i)] == segment && distance_from(plane, grid, i) > kOffPlane)
      of_cell_[static_cast<std::size_t>(i)] = kUngrown;
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
      segments_.push_back({static_cast<int>(queue_.size()), false});
    else
      for (int i : queue_) of_cell_[static_cast<std::size_t>(i)] = kNone;
  }
}

}  // namespace saccade
