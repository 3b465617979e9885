#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <opencv2/core.hpp>

namespace saccade {

/// Colour maps, from low to high: turbo is a rainbow of even steps, viridis and inferno also grow evenly in
/// lightness, so that they read the same in print and for people who confuse colours.
enum class Palette { turbo, viridis, inferno, gray };
constexpr std::array<Palette, 4> kPalettes = {Palette::turbo, Palette::viridis, Palette::inferno,
                                              Palette::gray};

std::string_view to_string(Palette palette);

/// The palette of that name; none if there is no such.
std::optional<Palette> palette_named(std::string_view name);

/// BGR, from the lowest value to the highest. Made at the first call; any thread.
using PaletteColours = std::array<cv::Vec3b, 256>;
const PaletteColours& colours_of(Palette palette);

/// What is shown as lowest and as highest.
struct ValueRange {
  float low = 0, high = 1;
  bool operator==(const ValueRange&) const = default;
};

/// The range of the values above 0 without the lowest and the highest of each `one_in` (>= 3) of them, from a
/// sample of every 7th pixel; none if no pixel of the sample is above 0.
std::optional<ValueRange> percentile_range(const cv::Mat1f& image, std::size_t one_in);

/// A map as an 8-bit gray picture for looking: 255 * sqrt(value / largest value), since a saliency map has
/// few strong and many weak pixels; all black if nothing is above 0.
cv::Mat1b to_gray(const cv::Mat1f& map);

struct DepthStyle {
  Palette palette = Palette::gray;
  std::optional<ValueRange> range_mm{};  ///< locked; none = percentile_range() of the image, one in 100
  bool operator==(const DepthStyle&) const = default;
};

/// A depth image as a picture for looking, BGR: near is the high end of the palette, far its low end, no
/// reading is black. What is beyond the range
/// goes on in the palette's ends, of which the range leaves some free.
cv::Mat3b depth_picture(const cv::Mat1f& depth_mm, const DepthStyle& style = {});

/// The colour in it of a depth at that share of the range, 0 = near .. 1 = far, BGR.
cv::Vec3b depth_colour(Palette palette, double share);

}  // namespace saccade
