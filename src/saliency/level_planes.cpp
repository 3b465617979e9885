#include "saliency/level_planes.hpp"

#include <algorithm>
#include <limits>

namespace saccade {
namespace {

constexpr int round_up(int value, int step) { return (value + step - 1) / step * step; }

}  // namespace

DepthPacking DepthPacking::for_depths(float largest_mm, bool multiples_of_eighths) {
  constexpr float kBits20 = 1 << 20, kBits21 = 1 << 21;
  const auto fits = [&](int rows, float units_per_mm, float bits) {
    return static_cast<float>(rows) * (largest_mm * units_per_mm + 1) < bits;  // and one for rounding
  };
  if (!multiples_of_eighths)
    for (float units = 256; units > 8; units /= 2)
      if (fits(4, units, kBits21)) return {units, kBits21, 4};
  if (fits(kMostRows, 8, kBits20)) return {8, kBits20, kMostRows};
  if (fits(7, 8, kBits21)) return {8, kBits21, 7};
  return {8, kBits21, 4};  // 65535 mm still fit
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
      9 * kVectorFloats;
  memory_ = hwy::AllocateAligned<float>(plane * kPlanes);
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

}  // namespace saccade
