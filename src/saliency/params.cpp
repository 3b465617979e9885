#include "saliency/params.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {
constexpr int kSmallestSide = 8;
}

Symmetry3dParams Symmetry3dParams::from(const Settings& s) {
  return {s.kernel, s.first_level, s.last_level, s.length_scale, s.normalisation};
}

cv::Size level_size(cv::Size image, int level) {
  for (int l = 0; l < level; ++l) image = {(image.width + 1) / 2, (image.height + 1) / 2};
  return image;
}

void check_levels(cv::Size image, const Symmetry3dParams& params) {
  const auto side = [&](int level) {
    const cv::Size size = level_size(image, level);
    return std::min(size.width, size.height);
  };
  if (side(params.last_level) >= kSmallestSide) return;
  int deepest = params.last_level;
  while (deepest >= 0 && side(deepest) < kSmallestSide) --deepest;
  const cv::Size last = level_size(image, params.last_level);
  throw usage_error(fmt::format("level {} has only {}x{} pixels", params.last_level, last.width, last.height),
                    fmt::format("{}x{} image", image.width, image.height),
                    deepest >= 0
                        ? fmt::format("try --levels {}..{}", std::min(params.first_level, deepest), deepest)
                        : fmt::format("an image needs at least {0}x{0} pixels", kSmallestSide));
}

}  // namespace saccade
