#include "saliency/probe.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace saccade {
namespace {

constexpr int kNormalReach = 2;    // of the 5 x 5 window of a normal
constexpr int kBinomialReach = 2;  // of the smoothing between two levels

// The pixels of one level that the master map interpolates between at the probed pixel, and their shares.
struct Corners {
  int row0, col0, row1, col1;
  double down, right;  // share of the second row, of the second column
};

Corners corners_at(int level, cv::Size size, int row, int col) {
  const double y = std::ldexp(row, -level), x = std::ldexp(col, -level);
  const int row0 = std::min(static_cast<int>(y), size.height - 1),
            col0 = std::min(static_cast<int>(x), size.width - 1);
  return {row0,     col0,    std::min(row0 + 1, size.height - 1), std::min(col0 + 1, size.width - 1),
          y - row0, x - col0};
}

// The part of `rect` within the image, from an even position on, so that halving keeps the even pixels.
cv::Rect fitted(cv::Rect rect, cv::Size size) {
  rect &= cv::Rect({}, size);
  const int odd_x = rect.x % 2, odd_y = rect.y % 2;
  return {rect.x - odd_x, rect.y - odd_y, rect.width + odd_x, rect.height + odd_y};
}

// The part of a level that the windows at the probed pixel and the normals in them need.
cv::Rect windows_at(int level, cv::Size image, const Symmetry3dParams& params, int row, int col) {
  const cv::Size size = level_size(image, level);
  const Corners c = corners_at(level, size, row, col);
  const int reach = kNormalReach + (level >= params.first_level ? params.kernel / 2 : 0);
  return fitted(
      {c.col0 - reach, c.row0 - reach, c.col1 - c.col0 + 2 * reach + 1, c.row1 - c.row0 + 2 * reach + 1},
      size);
}

// The part of a level that halving needs for the part `next` of the next level.
cv::Rect source_of(const cv::Rect& next) {
  return {2 * next.x - kBinomialReach, 2 * next.y - kBinomialReach, 2 * next.width - 1 + 2 * kBinomialReach,
          2 * next.height - 1 + 2 * kBinomialReach};
}

// The parts of levels 0..last_level that all of this needs.
std::vector<cv::Rect> needed_parts(cv::Size image, const Symmetry3dParams& params, int row, int col) {
  std::vector<cv::Rect> parts;
  for (int l = params.last_level; l >= 0; --l) {
    cv::Rect part = windows_at(l, image, params, row, col);
    if (!parts.empty()) part |= fitted(source_of(parts.back()), level_size(image, l));
    parts.push_back(part);
  }
  std::reverse(parts.begin(), parts.end());
  return parts;
}

// A cut-out of a level, as an image of its own for the functions of the reference.
struct Part {
  cv::Rect rect;
  reference::Level level;

  // `depth` is that of `whole`, which holds `rect`; `camera` is that of the level.
  Part(const cv::Mat1d& depth, const cv::Rect& whole, const cv::Rect& part, Intrinsics camera) : rect(part) {
    camera.cx -= part.x;
    camera.cy -= part.y;
    level = reference::make_level(depth(part - whole.tl()).clone(), camera);
  }
};

double score_at(const Part& part, int row, int col, const Symmetry3dParams& params) {
  const auto pixel = reference::symmetry_at(part.level, row - part.rect.y, col - part.rect.x, params);
  return pixel ? pixel->score() : 0;
}

LevelProbe probe_level(const Part& part, int level, cv::Size size, const Symmetry3dParams& params, int row,
                       int col) {
  const Corners at = corners_at(level, size, row, col);
  LevelProbe result;
  result.level = level;
  result.pixel = {at.right < 0.5 ? at.col0 : at.col1, at.down < 0.5 ? at.row0 : at.row1};
  const int r = result.pixel.y - part.rect.y, c = result.pixel.x - part.rect.x;
  result.depth_mm = part.level.depth_mm(r, c);
  result.symmetry = reference::symmetry_at(part.level, r, c, params);
  result.score = result.symmetry ? result.symmetry->score() : 0;

  const double side_px = std::ldexp(2 * (params.kernel / 2) + 1, level);
  result.footprint_px = {std::ldexp(result.pixel.x, level) - side_px / 2,
                         std::ldexp(result.pixel.y, level) - side_px / 2, side_px, side_px};
  result.footprint_mm = std::ldexp(side_px, -level) / part.level.camera.fx * result.depth_mm;

  // Eq. (15) is bilinear; corners with share 0 need not be computed.
  const auto share = [&](double weight, int corner_row, int corner_col) {
    return weight > 0 ? weight * score_at(part, corner_row, corner_col, params) : 0;
  };
  result.contribution = share((1 - at.down) * (1 - at.right), at.row0, at.col0) +
                        share((1 - at.down) * at.right, at.row0, at.col1) +
                        share(at.down * (1 - at.right), at.row1, at.col0) +
                        share(at.down * at.right, at.row1, at.col1);
  return result;
}

void describe_pixel(const Part& level0, Probe& probe) {
  const int r = probe.row - level0.rect.y, c = probe.col - level0.rect.x;
  const reference::Level& level = level0.level;
  probe.depth_mm = level.depth_mm(r, c);
  probe.position_mm = level.points_mm(r, c);
  if (level.normals(r, c) != cv::Vec3d()) probe.normal = level.normals(r, c);
}

}  // namespace

std::optional<std::size_t> LevelProbe::winner() const {
  if (!symmetry) return std::nullopt;
  const auto best = std::max_element(symmetry->planes.begin(), symmetry->planes.end(),
                                     [](const auto& a, const auto& b) { return a.score < b.score; });
  if (best->score <= 0) return std::nullopt;
  return static_cast<std::size_t>(best - symmetry->planes.begin());
}

Probe probe(const cv::Mat1f& depth_mm, const Intrinsics& camera, const Symmetry3dParams& params, int row,
            int col, std::span<const double> level_weights) {
  check_levels(depth_mm.size(), params);
  const auto levels = static_cast<std::size_t>(params.last_level - params.first_level + 1);
  if (!cv::Rect({}, depth_mm.size()).contains({col, row}))
    throw std::invalid_argument("probe: a pixel outside the image");
  if (!level_weights.empty() && level_weights.size() != levels)
    throw std::invalid_argument("probe: one weight for each level expected");

  Probe result;
  result.row = row;
  result.col = col;
  const std::vector<cv::Rect> parts = needed_parts(depth_mm.size(), params, row, col);
  cv::Mat1d depth;
  depth_mm(parts.front()).convertTo(depth, CV_64F);
  for (int l = 0; l <= params.last_level; ++l) {
    const cv::Rect& whole = parts[static_cast<std::size_t>(l)];
    if (l > 0) {
      // Halving is wrong at borders of the cut-out within the image; the pixels there are not used.
      const cv::Rect& finer = parts[static_cast<std::size_t>(l) - 1];
      depth = reference::halve(depth)(whole - finer.tl() / 2).clone();
    }
    const Part part(depth, whole, windows_at(l, depth_mm.size(), params, row, col), camera.at_level(l));
    if (l == 0) describe_pixel(part, result);
    if (l < params.first_level) continue;
    const auto i = static_cast<std::size_t>(l - params.first_level);
    result.levels.push_back(probe_level(part, l, level_size(depth_mm.size(), l), params, row, col));
    if (!level_weights.empty()) result.levels.back().contribution *= level_weights[i];
    result.saliency += result.levels.back().contribution;
  }
  return result;
}

std::string_view to_string(reference::PlaneVerdict verdict) {
  switch (verdict) {
    case reference::PlaneVerdict::half_empty:
      return "no points on one side";
    case reference::PlaneVerdict::no_direction:
      return "the halves coincide";
    case reference::PlaneVerdict::not_convex:
      return "not convex";
    case reference::PlaneVerdict::flat:
      return "flat";
    case reference::PlaneVerdict::scores:
      return "scores";
  }
  throw std::invalid_argument("to_string: not a verdict");
}

}  // namespace saccade
