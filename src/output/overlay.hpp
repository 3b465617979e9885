#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "output/colour_map.hpp"

namespace saccade {

/// How a saliency map is turned into colours.
struct MapStyle {
  Palette palette = Palette::turbo;
  double opacity = 0.8;  ///< of the most salient pixel, 0..1; less salient ones are more transparent
  double threshold = 0;  ///< share of the range, 0..1; what is below is not drawn
  std::optional<ValueRange>
      range{};  ///< locked; none = automatic, 0 to the largest value of the smoothed map
  bool operator==(const MapStyle&) const = default;
};

/// What the map lies on.
enum class Background {
  colour,  ///< the frame's colour image, its depth where it has none
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

/// The outlines of all proto-objects, the last fixation's first; pixels without depth inside an object are no
/// holes.
std::vector<Outline> proto_outlines(const Attention& attention);

/// The map as it is looked at: the lines of symmetry are a pixel or two wide, so it is smoothed by a Gaussian
/// of 1/200 of its width. The slow part of an overlay, and the same for every style.
cv::Mat1f smooth_for_looking(const cv::Mat1f& saliency);

/// The range in which a smoothed map is shown: the locked one, or 0 to its largest value.
ValueRange shown_range(const cv::Mat1f& smooth, const MapStyle& style);

/// The strength of each pixel, 0..255: 255 * sqrt(its place in the range), so that the weak is seen beside
/// the strong; 0 below the threshold and where the range is empty. An index into colours_of().
cv::Mat1b shown_strength(const cv::Mat1f& smooth, const MapStyle& style);

/// The range of the depth's colours in draw_background(); none if it draws no depth, or there is none.
std::optional<ValueRange> shown_depth_range(const Frame& frame, const OverlayStyle& style);

/// The frame without a map.
cv::Mat3b draw_background(const Frame& frame, const OverlayStyle& style);

/// out = picture * (1 - a) + colour(strength) * a with a = opacity * strength / 255, so that the unsalient
/// stays as it was. Both of one size.
void blend_map(cv::Mat3b& picture, const cv::Mat1b& strength, const MapStyle& style);

/// Fixations, scan path and outlines, as the style asks for them, for printing: the first fixation in green.
void draw_attention(cv::Mat3b& picture, const Attention& attention, const OverlayStyle& style);

/// All of it: the frame, the map over it and the numbered fixations. H x W, BGR. A pure function: the same
/// input gives the same pixels.
cv::Mat3b draw_overlay(const Frame& frame, const cv::Mat1f& saliency, const Attention& attention,
                       const OverlayStyle& style = {});

}  // namespace saccade
