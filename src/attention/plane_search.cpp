#include "attention/plane_search.hpp"

#include "attention/simd/plane_cells.hpp"

namespace saccade {
namespace {

constexpr std::size_t kFewestNormals = 20;

// The tangent plane of a cell. n.p is one number for all points p of a plane, and p = z * ray, so that
// 1/z = n.ray / (n.p).
std::optional<InversePlane> tangent_plane(const SurfaceGrid& grid, int i) {
  const Intrinsics& camera = grid.camera();
  const auto k = static_cast<std::size_t>(i);
  const double a = static_cast<double>(grid.normal_x()[k]) / camera.fx,
               b = static_cast<double>(grid.normal_y()[k]) / camera.fy;
  InversePlane plane{a, b, static_cast<double>(grid.normal_z()[k]) - a * camera.cx - b * camera.cy};
  const double along_ray = plane.at(i / grid.cols(), i % grid.cols());
  if (!(along_ray < 0)) return std::nullopt;  // normals face the camera; 0: seen edge-on
  const double scale = static_cast<double>(grid.inverse_depth()[k]) / along_ray;
  plane.a *= scale, plane.b *= scale, plane.c *= scale;
  return plane;
}

}  // namespace

std::optional<PlaneSearch::Found> PlaneSearch::find(const SurfaceGrid& grid, std::span<const int> cells) {
  sample(grid, cells);
  std::optional<InversePlane> plane = best_candidate(grid);
  if (!plane) return std::nullopt;
  for (int round = 0; round < kRounds; ++round)
    if (!refine(*plane, round == 0 ? kFirstReach : kReach)) return std::nullopt;
  return Found{*plane, share_in(*plane)};
}

void PlaneSearch::sample(const SurfaceGrid& grid, std::span<const int> cells) {
  for (auto* array : {&col_, &row_, &w_}) {
    array->clear();
    array->reserve(grid.size());
  }
  with_normal_.clear();
  with_normal_.reserve(grid.size());
  int row = 0, row_begin = 0;
  for (const int i : cells) {
    const auto k = static_cast<std::size_t>(i);
    if (grid.normal_z()[k] != 0) with_normal_.push_back(i);
    while (i >= row_begin + grid.cols()) ++row, row_begin += grid.cols();
    const int col = i - row_begin;
    if (row % 2 != 0 || col % 2 != 0) continue;
    col_.push_back(static_cast<float>(col));
    row_.push_back(static_cast<float>(row));
    w_.push_back(grid.inverse_depth()[k]);
  }
}

// Ties go to the candidate of the first cell.
std::optional<InversePlane> PlaneSearch::best_candidate(const SurfaceGrid& grid) const {
  if (with_normal_.size() < kFewestNormals) return std::nullopt;
  std::optional<InversePlane> best;
  int most = 0;
  std::size_t before = with_normal_.size();
  for (int k = 0; k < kCandidates; ++k) {
    const std::size_t seed = static_cast<std::size_t>(k) * (with_normal_.size() - 1) / (kCandidates - 1);
    if (seed == before) continue;
    before = seed;
    const auto candidate = tangent_plane(grid, with_normal_[seed]);
    if (!candidate) continue;
    const int count =
        count_in_plane(counted(), static_cast<float>(candidate->a), static_cast<float>(candidate->b),
                       static_cast<float>(candidate->c), kCandidateReach, most);
    if (count > most) most = count, best = candidate;
  }
  return best;
}

// Least squares over the cells within `reach` of the plane. False if they do not make a plane.
bool PlaneSearch::refine(InversePlane& plane, double reach) const {
  const PlaneSums s = sum_in_plane(counted(), plane.a, plane.b, plane.c, reach);
  const double uu = s.n * s.uu - s.u * s.u, vv = s.n * s.vv - s.v * s.v, uv = s.n * s.uv - s.u * s.v;
  const double determinant = uu * vv - uv * uv;
  if (s.n < 3 || determinant <= 0) return false;
  const double uw = s.n * s.uw - s.u * s.w, vw = s.n * s.vw - s.v * s.w;
  plane.a = (uw * vv - vw * uv) / determinant;
  plane.b = (vw * uu - uw * uv) / determinant;
  plane.c = (s.w - plane.a * s.u - plane.b * s.v) / s.n;
  return true;
}

PlaneCells PlaneSearch::counted() const { return {col_.data(), row_.data(), w_.data(), w_.size()}; }

double PlaneSearch::share_in(const InversePlane& plane) const {
  const PlaneSums sums = sum_in_plane(counted(), plane.a, plane.b, plane.c, kReach);
  return sums.n / static_cast<double>(w_.size());
}

}  // namespace saccade
