#include "output/colour_map.hpp"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

constexpr std::array<std::string_view, kPalettes.size()> kNames = {"turbo", "viridis", "inferno", "grey"};

constexpr int kFarShade = 45, kShades = 190;  // of a depth picture

PaletteColours make_colours(Palette palette) {
  cv::Mat1b ramp(1, 256);
  for (int i = 0; i < 256; ++i) ramp(i) = static_cast<std::uint8_t>(i);
  cv::Mat3b colours;
  switch (palette) {
    case Palette::turbo:
      cv::applyColorMap(ramp, colours, cv::COLORMAP_TURBO);
      break;
    case Palette::viridis:
      cv::applyColorMap(ramp, colours, cv::COLORMAP_VIRIDIS);
      break;
    case Palette::inferno:
      cv::applyColorMap(ramp, colours, cv::COLORMAP_INFERNO);
      break;
    case Palette::grey:
      cv::cvtColor(ramp, colours, cv::COLOR_GRAY2BGR);
      break;
  }
  PaletteColours result;
  std::copy(colours.begin(), colours.end(), result.begin());
  return result;
}

}  // namespace

std::string_view to_string(Palette palette) { return kNames[static_cast<std::size_t>(palette)]; }

std::optional<Palette> palette_named(std::string_view name) {
  for (const Palette palette : kPalettes)
    if (to_string(palette) == name) return palette;
  return std::nullopt;
}

const PaletteColours& colours_of(Palette palette) {
  static const std::array<PaletteColours, kPalettes.size()> all = {
      make_colours(Palette::turbo), make_colours(Palette::viridis), make_colours(Palette::inferno),
      make_colours(Palette::grey)};
  return all[static_cast<std::size_t>(palette)];
}

std::optional<ValueRange> percentile_range(const cv::Mat1f& image, double percent) {
  constexpr int kSampleStep = 7;  // enough pixels for two percentiles
  std::vector<float> sample;
  for (int r = 0; r < image.rows; ++r)
    for (int c = r % kSampleStep; c < image.cols; c += kSampleStep)
      if (image(r, c) > 0) sample.push_back(image(r, c));
  if (sample.empty()) return std::nullopt;
  const auto beyond = static_cast<std::ptrdiff_t>(static_cast<double>(sample.size()) * percent / 100);
  const auto low = sample.begin() + beyond, high = sample.end() - 1 - beyond;
  std::nth_element(sample.begin(), low, sample.end());
  const float low_value = *low;
  std::nth_element(low, high, sample.end());
  return ValueRange{low_value, *high};
}

cv::Mat1b root_picture(const cv::Mat1f& map, double scale, double shift) {
  constexpr int kBandRows = 16;  // the temporary values of a band stay in the cache
  cv::Mat1b picture(map.size());
  cv::Mat1f places;
  for (int begin = 0; begin < map.rows; begin += kBandRows) {
    const cv::Range rows(begin, std::min(begin + kBandRows, map.rows));
    map.rowRange(rows).convertTo(places, CV_32F, scale, shift);
    cv::max(places, 0.0, places);
    cv::sqrt(places, places);
    cv::Mat1b band = picture.rowRange(rows);
    places.convertTo(band, CV_8U, 255);
  }
  return picture;
}

cv::Mat1b to_grey(const cv::Mat1f& map) {
  double largest = 0;
  cv::minMaxLoc(map, nullptr, &largest);
  if (largest <= 0) return cv::Mat1b(map.size(), std::uint8_t{0});
  return root_picture(map, 1 / largest, 0);
}

cv::Vec3b depth_colour(Palette palette, double share) {
  return colours_of(palette)[cv::saturate_cast<std::uint8_t>(kFarShade + kShades * (1 - share))];
}

std::optional<ValueRange> shown_range(const cv::Mat1f& depth_mm, const DepthStyle& style) {
  return style.range_mm ? style.range_mm : percentile_range(depth_mm, style.percentile);
}

cv::Mat3b depth_picture(const cv::Mat1f& depth_mm, const DepthStyle& style) {
  cv::Mat3b picture(depth_mm.size(), cv::Vec3b());
  const std::optional<ValueRange> range = shown_range(depth_mm, style);
  if (!range) return picture;
  const float span_mm = std::max(range->high - range->low, 1.0F);

  cv::Mat1b shade;
  depth_mm.convertTo(shade, CV_8U, -kShades / span_mm, kFarShade + kShades * range->high / span_mm);
  const PaletteColours& colours = colours_of(style.palette);
  for (int r = 0; r < picture.rows; ++r)
    for (int c = 0; c < picture.cols; ++c)
      if (depth_mm(r, c) > 0) picture(r, c) = colours[shade(r, c)];
  return picture;
}

}  // namespace saccade
