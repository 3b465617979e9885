#include "saliency/simd/level_planes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "saliency/simd/aligned_memory.hpp"

namespace saccade {
namespace {

constexpr int round_up(int value, int step) { return (value + step - 1) / step * step; }

}  // namespace

DepthPacking DepthPacking::for_depths(float largest_mm, bool multiples_of_eighths, int rows) {
  const auto bits = [](double largest) {
    return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(largest)));
  };
  DepthPacking packing;
  const auto depth_bits_of = [&](int together) {
    return bits(together * rows * (std::ceil(static_cast<double>(largest_mm) * packing.units_per_mm) + 1));
  };
  const auto fits = [&](int together) { return depth_bits_of(together) + bits(together * rows) <= 32; };
  packing.units_per_mm = multiples_of_eighths ? 8 : 256;
  while (packing.units_per_mm > 8 && largest_mm * packing.units_per_mm > kMostUnits)
    packing.units_per_mm /= 2;
  while (!fits(1)) packing.units_per_mm /= 2;
  packing.columns = 1;
  while (packing.columns < rows && fits(packing.columns + 1)) ++packing.columns;
  packing.depth_bits = depth_bits_of(packing.columns);
  return packing;
}

LevelPlanes::LevelPlanes(cv::Size size, int reach)
    : width_(size.width), height_(size.height), margin_cols_(round_up(reach, kVectorFloats)) {
  // The last vector of a row may begin at its last pixel, and its window reaches on from there.
  int stride = margin_cols_ + round_up(width_, kVectorFloats) + margin_cols_;
  // Rows a power of two apart would compete for the same cache lines.
  if (stride % 128 == 0) stride += kVectorFloats;
  stride_ = stride;
  const std::size_t plane =
      static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_ + 2 * kMarginRows) +
      std::size_t{9} * kVectorFloats;
  memory_ = allocate_aligned<float>(plane * kPlanes);
  for (std::size_t p = 0; p < kPlanes; ++p) {
    float* begin = memory_.get() + p * plane;
    std::fill(begin, begin + plane, p == kUsableInverse ? std::numeric_limits<float>::quiet_NaN() : 0.0f);
    planes_[p] = begin + kMarginRows * stride_ + margin_cols_;
  }
}

void LevelPlanes::scale_scores(float weight) {
  for (int r = 0; r < height_; ++r) {
    float* scores = row(kScore, r);
    std::transform(scores, scores + width_, scores, [=](float score) { return score * weight; });
  }
}

void LevelPlanes::copy_scores(cv::Mat1f& map) const {
  map.create(height_, width_);
  for (int r = 0; r < height_; ++r) std::copy_n(row(kScore, r), width_, map[r]);
}

void LevelPlanes::copy_normals(cv::Mat3f& normals) const {
  normals.create(height_, width_);
  for (int r = 0; r < height_; ++r) {
    const float *x = row(kNormalX, r), *y = row(kNormalY, r), *z = row(kNormalZ, r);
    for (int c = 0; c < width_; ++c) normals(r, c) = {x[c], y[c], z[c]};
  }
}

}  // namespace saccade
