#include "tracking/surface_memory.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/cell_projection.hpp"

namespace saccade {
namespace {

constexpr double kLeastWeight = 0.1;  // of bilinear interpolation; less of the same surface is none
constexpr double kEdge = 0.5;         // cells; a step is of this cell if it is nearer than this

}  // namespace

double SurfaceMemory::share_of(double seconds, double mean_s) { return 1 - std::exp(-seconds / mean_s); }

void SurfaceMemory::clear() { empty_ = true; }

void SurfaceMemory::forget_means() {
  std::fill(now_.age.begin(), now_.age.end(), -1);  // carry() adds 1
}

void SurfaceMemory::carry(const SurfaceGrid& grid, const cv::Affine3d& to_previous) {
  std::swap(now_, last_);
  now_.depth_mm = grid.depth_mm();
  now_.mean.assign(grid.size(), 0.0F);
  now_.age.assign(grid.size(), 0);
  now_.owner.assign(grid.size(), kNobody);
  before_.assign(grid.size(), Before::unknown);
  if (empty_ || last_.depth_mm.size() != grid.size()) return;
  const Intrinsics& camera = grid.camera();
  std::size_t i = 0;
  for (int r = 0; r < grid.rows(); ++r)
    for (int c = 0; c < grid.cols(); ++c, ++i) {
      const double z = static_cast<double>(grid.depth_mm()[i]);
      if (z == 0) continue;
      const cv::Point3d p = to_previous * camera.point_mm(r, c, z);
      if (!(p.z > 0)) continue;
      carry_cell(i, {camera.fy * p.y / p.z + camera.cy, camera.fx * p.x / p.z + camera.cx, p.z}, grid.rows(),
                 grid.cols());
    }
}

// Mean: bilinear over the cells of the same surface. Age and owner: of the nearest of them.
void SurfaceMemory::carry_cell(std::size_t i, const Place& place, int rows, int cols) {
  const int top = static_cast<int>(std::floor(place.row)), left = static_cast<int>(std::floor(place.col));
  double weights = 0, sum = 0, largest = 0;
  for (int r = top; r <= top + 1; ++r)
    for (int c = left; c <= left + 1; ++c) {
      if (r < 0 || c < 0 || r >= rows || c >= cols) continue;
      const auto j = static_cast<std::size_t>(r * cols + c);
      const double z = static_cast<double>(last_.depth_mm[j]);
      if (z == 0) continue;
      const double away_row = std::abs(place.row - r), away_col = std::abs(place.col - c);
      const double weight = (1 - away_row) * (1 - away_col);
      if (std::abs(z - place.depth_mm) > kSameDepth * place.depth_mm) {
        if (away_row <= kEdge && away_col <= kEdge)
          before_[i] = z > place.depth_mm ? Before::behind : Before::in_front;
        continue;
      }
      weights += weight;
      sum += weight * static_cast<double>(last_.mean[j]);
      if (weight <= largest) continue;
      largest = weight;
      now_.age[i] = last_.age[j] + 1;
      now_.owner[i] = last_.owner[j];
    }
  if (weights < kLeastWeight) {
    now_.age[i] = 0;
    now_.owner[i] = kNobody;
    return;
  }
  before_[i] = Before::same;
  now_.mean[i] = static_cast<float>(sum / weights);
}

void SurfaceMemory::learn(const std::vector<float>& values, double seconds) {
  const double least = share_of(seconds);
  for (std::size_t i = 0; i < values.size(); ++i) {
    float& mean = now_.mean[i];
    if (now_.age[i] == 0)
      mean = values[i];
    else
      mean += static_cast<float>(std::max(1.0 / (now_.age[i] + 1), least)) * (values[i] - mean);
  }
  empty_ = false;
}

}  // namespace saccade
