#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <opencv2/core.hpp>

namespace saccade {

/// Colour maps. Turbo is a perceptually even rainbow; viridis and inferno also grow evenly in lightness, so
/// that they work in black-and-white print and with colour blindness.
enum class Palette { turbo, viridis, inferno, grey };
constexpr std::array<Palette, 4> kPalettes = {Palette::turbo, Palette::viridis, Palette::inferno,
                                              Palette::grey};

std::string_view to_string(Palette palette);

/// The palette of that name, if there is one.
std::optional<Palette> palette_named(std::string_view name);

/// BGR, from the lowest value to the highest. Computed at the first call; any thread.
using PaletteColours = std::array<cv::Vec3b, 256>;
const PaletteColours& colours_of(Palette palette);

/// The values shown with the first and the last colour of a palette.
struct ValueRange {
  float low = 0, high = 1;
  bool operator==(const ValueRange&) const = default;
};

/// The range of the values above 0 without the lowest and the highest `percent` (0..49) of them, from a
/// sample of every 7th pixel; none if no pixel of the sample is above 0.
std::optional<ValueRange> percentile_range(const cv::Mat1f& image, double percent);

/// 255 * sqrt(place) with place = value * scale + shift, cut to 0..1: weak values are visible beside strong
/// ones. H x W, 8 bits.
cv::Mat1b root_picture(const cv::Mat1f& map, double scale, double shift);

/// A map as an 8-bit grey picture: 255 * sqrt(value / largest value), since a saliency map has few strong and
/// many weak pixels; all black if no value is above 0.
cv::Mat1b to_grey(const cv::Mat1f& map);

struct DepthStyle {
  Palette palette = Palette::grey;
  std::optional<ValueRange> range_mm{};  ///< fixed; none = percentile_range() of the image
  double percentile = 1;                 ///< for that, 0..25
  bool operator==(const DepthStyle&) const = default;
};

/// The depths shown with the first and the last colour, mm; none for an image without a reading and a fixed
/// range.
std::optional<ValueRange> shown_range(const cv::Mat1f& depth_mm, const DepthStyle& style);

/// A depth image as a BGR picture: near is the high end of the palette, far the low end, no reading black.
/// The range leaves out the two ends of the palette, which show depths beyond it.
cv::Mat3b depth_picture(const cv::Mat1f& depth_mm, const DepthStyle& style = {});

/// The colour of a depth in that picture, BGR; `share`: its place in the range, 0 = near .. 1 = far.
cv::Vec3b depth_colour(Palette palette, double share);

}  // namespace saccade
