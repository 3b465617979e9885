#include "saliency/level_planes.hpp"

#include <algorithm>
#include <limits>

namespace saccade {
namespace {

constexpr int round_up(int value, int step) { return (value + step - 1) / step * step; }

}  // namespace

DepthPacking DepthPacking::for_depths_up_to(float largest_mm) {
  constexpr float kBits20 = 1 << 20, kBits21 = 1 << 21;
  const float units = largest_mm * kUnitsPerMm + 1;  // and one for rounding
  if (15 * units < kBits20) return {kBits20, 15};
  if (7 * units < kBits21) return {kBits21, 7};
  return {kBits21, 4};  // 4 * 65535 mm still fits
}

LevelPlanes::LevelPlanes(cv::Size size, int reach)
    : width_(size.width), height_(size.height), margin_cols_(round_up(reach, kVectorFloats)) {
  // The last vector of a row may begin at its last pixel, and its window reaches on from there.
  int stride = margin_cols_ + round_up(width_, kVectorFloats) + margin_cols_;
  // Rows a power of two apart would compete for the same cache lines.
  if (stride % 128 == 0) stride += kVectorFloats;
  stride_ = stride;
  const std::size_t plane = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_ + 2 * kMarginRows) +
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
