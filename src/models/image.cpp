#include "models/image.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {

const cv::Mat3b& colour_of(const Frame& frame, const char* model) {
  if (frame.colour.empty())
    throw unreadable(fmt::format("model {} needs colour", model),
                     fmt::format("frame {} has only depth", frame.index),
                     "try --model symmetry3d, which works on depth alone");
  return frame.colour;
}

void upsample_rows(const cv::Mat1f& coarse, int levels, cv::Mat1f& fine, bool add, int begin, int end) {
  const int factor = 1 << levels;
  const float step = 1.0F / static_cast<float>(factor);
  for (int r = begin; r < end; ++r) {
    const float* upper = coarse[std::min(r / factor, coarse.rows - 1)];
    const float* lower = coarse[std::min(r / factor + 1, coarse.rows - 1)];
    const float down = static_cast<float>(r % factor) * step;
    const auto value = [&](int i) {
      i = std::min(i, coarse.cols - 1);
      return upper[i] + (lower[i] - upper[i]) * down;
    };
    float* out = fine[r];
    float left = value(0);
    for (int c = 0; c < fine.cols; c += factor) {
      const float right = value(c / factor + 1), slope = (right - left) * step;
      for (int i = 0; i < std::min(factor, fine.cols - c); ++i) {
        const float here = left + slope * static_cast<float>(i);
        out[c + i] = add ? out[c + i] + here : here;
      }
      left = right;
    }
  }
}

}  // namespace saccade
