#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace saccade {

/// The channels B, G, R of one row of an image, each in an array of its own.
using ColourRows = std::array<const std::uint8_t*, 3>;

/// Writes (B + G + R)/3, in 0..1, to intensity[0..width) and returns the largest.
float find_intensity(const ColourRows& bgr, float* intensity, std::size_t width);

/// The article's equations for R, G, B and Y, where the colours are divided by the intensity if that is above
/// `least`, else 0: writes R - G to red_green[0..width) and B - Y to blue_yellow[0..width). The same bits
/// with every instruction set.
void find_opponency(const ColourRows& bgr, const float* intensity, float least, float* red_green,
                    float* blue_yellow, std::size_t width);

}  // namespace saccade
