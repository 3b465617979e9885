#include "core/depth_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace saccade {
namespace {

constexpr double kNearest_mm = 100, kFarthest_mm = 15000, kUsable_mm = 65535;

// Of real numbers and NaN, the positive ones.
std::vector<float> readings(const cv::Mat1f& depth_mm) {
  std::vector<float> values;
  values.reserve(depth_mm.total());
  std::ranges::copy_if(depth_mm, std::back_inserter(values), [](float depth) { return depth > 0; });
  return values;
}

// The unit, of those in use, that would bring a median of `units` stored units nearest to 2 m; 0 = none.
double likely_unit(double units) {
  // mm; tenths (recordings), TUM, RealSense L515, 1/256 m (street scenes), 1/8000 m, cm, m, um.
  constexpr std::array kUnits = {1.0, 0.1, 0.2, 0.25, 1000.0 / 256, 0.125, 10.0, 1000.0, 0.001};
  constexpr double kUsual_mm = 2000;
  const auto distance = [&](double unit) { return std::abs(std::log(units * unit / kUsual_mm)); };
  const double best = *std::ranges::min_element(kUnits, {}, distance);
  return units * best >= kNearest_mm && units * best <= kFarthest_mm ? best : 0;
}

}  // namespace

void depth_from_units(const cv::Mat1w& stored, double unit_mm, cv::Mat1f& depth_mm) {
  depth_mm.create(stored.size());
  for (int row = 0; row < stored.rows; ++row) {
    const std::uint16_t* in = stored[row];
    float* out = depth_mm[row];
    for (int col = 0; col < stored.cols; ++col)
      out[col] = in[col] > kLargestStoredDepth ? 0.0F : static_cast<float>(in[col] * unit_mm);
  }
}

void depth_from_reals(const cv::Mat1f& values, double mm_per_unit, cv::Mat1f& depth_mm) {
  depth_mm.create(values.size());
  std::transform(values.begin(), values.end(), depth_mm.begin(), [&](float value) {
    const auto depth = static_cast<float>(static_cast<double>(value) * mm_per_unit);
    return depth > 0 && std::isfinite(depth) ? depth : 0.0F;
  });
}

DepthLosses& DepthLosses::operator+=(const DepthLosses& other) {
  rounded_pixels += other.rounded_pixels;
  largest_rounding_mm = std::max(largest_rounding_mm, other.largest_rounding_mm);
  out_of_range_pixels += other.out_of_range_pixels;
  return *this;
}

DepthLosses depth_to_units(const cv::Mat1f& depth_mm, double unit_mm, cv::Mat1w& stored) {
  DepthLosses losses;
  stored.create(depth_mm.size());
  std::transform(depth_mm.begin(), depth_mm.end(), stored.begin(), [&](float depth) -> std::uint16_t {
    if (!(depth > 0)) return 0;
    const double units = std::round(static_cast<double>(depth) / unit_mm);
    if (units < 1 || units > kLargestStoredDepth) {
      ++losses.out_of_range_pixels;
      return 0;
    }
    if (static_cast<float>(units * unit_mm) != depth) {
      ++losses.rounded_pixels;
      losses.largest_rounding_mm =
          std::max(losses.largest_rounding_mm, std::abs(units * unit_mm - static_cast<double>(depth)));
    }
    return static_cast<std::uint16_t>(units);
  });
  return losses;
}

double unit_for(const cv::Mat1f& depth_mm) {
  constexpr double kReserve = 1.25;  // later frames may reach farther
  const auto whole = [](float depth) { return depth == std::trunc(depth); };
  if (depth_mm.empty() || std::ranges::all_of(depth_mm, whole)) return 1;
  const double farthest = static_cast<double>(*std::ranges::max_element(depth_mm));
  for (const double unit : {0.1, 0.2})
    if (farthest * kReserve <= kLargestStoredDepth * unit) return unit;
  return 1;
}

std::optional<std::string> describe_implausible_depth(const cv::Mat1f& depth_mm, double unit_mm) {
  std::vector<float> values = readings(depth_mm);
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const auto median = static_cast<double>(*middle);
  if (median >= kNearest_mm && median <= kFarthest_mm) return std::nullopt;
  std::string text = fmt::format("depth is implausible, its median is {:.3g} {}",
                                 median < 1e4 ? median : median / 1e3, median < 1e4 ? "mm" : "m");
  if (median > kUsable_mm) text += ", and nothing beyond 65.5 m can be used";
  const double unit = unit_mm > 0 ? unit_mm : 1;
  const double likely = likely_unit(median / unit);
  if (likely > 0) text += fmt::format("; its unit is likely {0:.6g} mm: try --depth-unit {0:.6g}", likely);
  return text;
}

}  // namespace saccade
