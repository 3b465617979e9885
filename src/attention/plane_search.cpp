#include "attention/plane_search.hpp"

#include <algorithm>
#include <cmath>

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
  const double along_ray = plane.at(i, grid.cols());
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
  for (const int i : cells) {
    const auto k = static_cast<std::size_t>(i);
    if (grid.normal_z()[k] != 0) with_normal_.push_back(i);
    const int row = i / grid.cols(), col = i % grid.cols();
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
    const int count = candidate ? votes(*candidate, most) : 0;
    if (count > most) most = count, best = candidate;
  }
  return best;
}

// Of a plane that has more than `least`; else any number up to that, since the count ends when the rest is
// too few. A sum of ones and no branch within a block, so that compilers make vectors of it.
int PlaneSearch::votes(const InversePlane& plane, int least) const {
  constexpr int kBlock = 256;
  const float a = static_cast<float>(plane.a), b = static_cast<float>(plane.b),
              c = static_cast<float>(plane.c);
  const float *col = col_.data(), *row = row_.data(), *w = w_.data();
  const int cells = static_cast<int>(w_.size());
  int count = 0;
  for (int begin = 0; begin < cells && count + (cells - begin) > least; begin += kBlock) {
    const int end = std::min(begin + kBlock, cells);
    for (int i = begin; i < end; ++i)
      count += std::abs(a * col[i] + b * row[i] + c - w[i]) <= kCandidateReach * w[i] ? 1 : 0;
  }
  return count;
}

// Least squares over the cells within `reach` of the plane. False if they do not make a plane.
bool PlaneSearch::refine(InversePlane& plane, double reach) const {
  double n = 0, su = 0, sv = 0, suu = 0, svv = 0, suv = 0, sw = 0, suw = 0, svw = 0;
  for (std::size_t i = 0; i < w_.size(); ++i) {
    const double u = static_cast<double>(col_[i]), v = static_cast<double>(row_[i]),
                 w = static_cast<double>(w_[i]);
    if (std::abs(plane.a * u + plane.b * v + plane.c - w) > reach * w) continue;
    n += 1, su += u, sv += v, suu += u * u, svv += v * v, suv += u * v;
    sw += w, suw += u * w, svw += v * w;
  }
  const double uu = n * suu - su * su, vv = n * svv - sv * sv, uv = n * suv - su * sv;
  const double determinant = uu * vv - uv * uv;
  if (n < 3 || determinant <= 0) return false;
  const double uw = n * suw - su * sw, vw = n * svw - sv * sw;
  plane.a = (uw * vv - vw * uv) / determinant;
  plane.b = (vw * uu - uw * uv) / determinant;
  plane.c = (sw - plane.a * su - plane.b * sv) / n;
  return true;
}

double PlaneSearch::share_in(const InversePlane& plane) const {
  int in = 0;
  for (std::size_t i = 0; i < w_.size(); ++i) {
    const double w = static_cast<double>(w_[i]);
    const double at =
        plane.a * static_cast<double>(col_[i]) + plane.b * static_cast<double>(row_[i]) + plane.c;
    in += std::abs(at - w) <= kReach * w ? 1 : 0;
  }
  return static_cast<double>(in) / static_cast<double>(w_.size());
}

}  // namespace saccade
