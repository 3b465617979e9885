#include "models/image.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core/hal/intrin.hpp>

#include "core/error.hpp"

namespace saccade {

const cv::Mat3b& colour_of(const Frame& frame, const char* model) {
  if (frame.colour.empty())
    throw unreadable(fmt::format("model {} needs colour", model),
                     fmt::format("frame {} has only depth", frame.index),
                     "try --model symmetry3d, which works on depth alone");
  return frame.colour;
}

namespace {

// Interpolates `coarse` at steps of 1/Factor into out[0..width); coarse[i] and the next value are `Factor`
// pixels apart. Compilers make vectors of the inner loop from a Factor of 4 on.
template <int Factor, bool Add>
void expand(const std::vector<float>& coarse, float* out, int width) {
  constexpr float kStep = 1.0F / Factor;
  const auto write = [&](int begin, int count) {
    const float left = coarse[static_cast<std::size_t>(begin / Factor)];
    const float slope = (coarse[static_cast<std::size_t>(begin / Factor) + 1] - left) * kStep;
    for (int i = 0; i < count; ++i) {
      const float here = left + slope * static_cast<float>(i);
      out[begin + i] = Add ? out[begin + i] + here : here;
    }
  };
  int c = 0;
  if constexpr (Factor == 2) {
    using Lanes = cv::v_float32x4;
    const Lanes step = cv::v_setall_f32(kStep);
    for (; c + 2 * Lanes::nlanes <= width; c += 2 * Lanes::nlanes) {
      const float* const from = coarse.data() + c / 2;
      const Lanes left = cv::v_load(from), slope = (cv::v_load(from + 1) - left) * step;
      Lanes even = left, odd = left + slope;
      if constexpr (Add) {
        Lanes even_before, odd_before;
        cv::v_load_deinterleave(out + c, even_before, odd_before);
        even = even_before + even, odd = odd_before + odd;
      }
      cv::v_store_interleave(out + c, even, odd);
    }
  }
  for (; c + Factor <= width; c += Factor) write(c, Factor);
  if (c < width) write(c, width - c);
}

template <bool Add>
void expand(const std::vector<float>& coarse, int levels, float* out, int width) {
  switch (levels) {
    case 0:
      return expand<1, Add>(coarse, out, width);
    case 1:
      return expand<2, Add>(coarse, out, width);
    case 2:
      return expand<4, Add>(coarse, out, width);
    case 3:
      return expand<8, Add>(coarse, out, width);
    case 4:
      return expand<16, Add>(coarse, out, width);
    default:
      throw std::invalid_argument("upsample_rows: 0..4 levels expected");
  }
}

}  // namespace

void upsample_rows(const cv::Mat1f& coarse, int levels, cv::Mat1f& fine, bool add, int begin, int end) {
  const int factor = 1 << levels;
  const float step = 1.0F / static_cast<float>(factor);
  const auto width = static_cast<std::size_t>(coarse.cols);
  // A row between two of `coarse`. Columns beyond its last one repeat it.
  std::vector<float> row(std::max(width, static_cast<std::size_t>(fine.cols / factor + 1)) + 1);
  for (int r = begin; r < end; ++r) {
    const float* upper = coarse[std::min(r / factor, coarse.rows - 1)];
    const float* lower = coarse[std::min(r / factor + 1, coarse.rows - 1)];
    const float down = static_cast<float>(r % factor) * step;
    for (std::size_t i = 0; i < width; ++i) row[i] = upper[i] + (lower[i] - upper[i]) * down;
    std::fill(row.begin() + coarse.cols, row.end(), row[width - 1]);
    if (add)
      expand<true>(row, levels, fine[r], fine.cols);
    else
      expand<false>(row, levels, fine[r], fine.cols);
  }
}

}  // namespace saccade
