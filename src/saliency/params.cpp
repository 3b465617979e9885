#include "saliency/params.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {
constexpr int kSmallestSide = 8;
}

std::optional<double> Symmetry3dParams::lambda_px() const {
  if (length_scale == LengthScale::millimetre) return std::nullopt;
  return 0.05 * kernel;
}

cv::Size level_size(cv::Size image, int level) {
  for (int l = 0; l < level; ++l) image = {(image.width + 1) / 2, (image.height + 1) / 2};
  return image;
}

int deepest_level(cv::Size image) {
  int level = -1;
  while (std::min(image.width, image.height) >= kSmallestSide) {
    image = level_size(image, 1);
    ++level;
  }
  return level;
}

void check_levels(cv::Size image, const Symmetry3dParams& params) {
  const int deepest = deepest_level(image);
  if (params.last_level <= deepest) return;
  const std::string size = fmt::format("{}x{} image", image.width, image.height);
  if (deepest < 0)
    throw unreadable("the image is too small", size,
                     fmt::format("at least {0}x{0} pixels are needed", kSmallestSide));
  const cv::Size last = level_size(image, params.last_level);
  throw usage_error(fmt::format("level {} has only {}x{} pixels", params.last_level, last.width, last.height),
                    size, fmt::format("try --levels {}..{}", std::min(params.first_level, deepest), deepest));
}

}  // namespace saccade
