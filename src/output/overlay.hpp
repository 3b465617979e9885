#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "output/colour_map.hpp"

namespace saccade {

/// How a saliency map is coloured.
struct MapStyle {
  Palette palette = Palette::turbo;
  double opacity = 0.8;  ///< of the most salient pixel, 0..1; less salient ones are more transparent
  double threshold = 0;  ///< share of the range, 0..1; values below it are not drawn
  /// Fixed; none = 0 to the largest value of the smoothed map.
  std::optional<ValueRange> range{};
  bool operator==(const MapStyle&) const = default;
};

/// The picture below the map.
enum class Background {
  colour,  ///< the frame's colour image, or its depth if there is none
  depth,
};

struct OverlayStyle {
  Background background = Background::colour;
  DepthStyle depth{};
  MapStyle map{};
  bool outlines = true;  ///< of the proto-objects
  bool marks = true;     ///< numbered fixations
  bool path = true;      ///< lines from fixation to fixation
  bool operator==(const OverlayStyle&) const = default;
};

/// The outer contour of a proto-object, or of a part of one, in pixels.
struct Outline {
  std::size_t rank = 0;  ///< of its fixation, from 1
  std::vector<cv::Point> points;
};

/// The outlines of all proto-objects, from the last fixation to the first. Pixels without depth inside an
/// object do not make holes.
std::vector<Outline> proto_outlines(const Attention& attention);

/// The map smoothed for display by a Gaussian of 1/200 of its width, since lines of symmetry are only a pixel
/// or two wide. The slow part of an overlay, and independent of the style.
cv::Mat1f smooth_for_looking(const cv::Mat1f& saliency);

/// The range in which a smoothed map is shown: that of the style, or 0 to the largest value.
ValueRange shown_range(const cv::Mat1f& smooth, const MapStyle& style);

/// The strength of each pixel: 255 * sqrt(place in the range, 0..1), so that weak values are visible beside
/// strong ones; 0 below the threshold, and everywhere if the range is empty. An index into colours_of().
cv::Mat1b shown_strength(const cv::Mat1f& smooth, const MapStyle& style);

/// The range of the depth's colours in draw_background(); none if it draws no depth, or there is none.
std::optional<ValueRange> shown_depth_range(const Frame& frame, const OverlayStyle& style);

/// The frame without a map.
cv::Mat3b draw_background(const Frame& frame, const OverlayStyle& style);

/// picture = picture * (1 - a) + colour(strength) * a with a = opacity * strength / 255. Throws
/// std::invalid_argument if the sizes differ.
void blend_map(cv::Mat3b& picture, const cv::Mat1b& strength, const MapStyle& style);

/// The colour of an object over time, BGR, by its id; ids that are close to each other differ clearly in hue.
cv::Scalar object_colour(int id);

/// Draws the fixations, scan path and outlines that the style has, doubtful ones (is_doubtful) in grey. Frame
/// by frame, fixations are numbered by rank, the first in green; over time by id, each object in its colour,
/// without a scan path but with a ring around the object that is looked at.
void draw_attention(cv::Mat3b& picture, const Attention& attention, const OverlayStyle& style);

/// The frame, the map over it, and the numbered fixations: H x W, BGR. The same input gives the same pixels.
cv::Mat3b draw_overlay(const Frame& frame, const cv::Mat1f& saliency, const Attention& attention,
                       const OverlayStyle& style = {});

}  // namespace saccade
