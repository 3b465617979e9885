#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// A picture as a list of shapes, in px from the top left corner; later ones lie over earlier ones. Two back
/// ends show it: to_svg() and to_picture().
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

struct Line {
  std::vector<cv::Point2d> points;
  Colour colour;
  double width = 1;
  std::array<double, 2> dash = {0, 0};  ///< length drawn and length left out; 0, 0 = solid
};

struct Area {
  std::vector<cv::Point2d> corners;
  Colour colour;
  double opacity = 1;  ///< 0..1
};

enum class Anchor { start, middle, end };

struct Text {
  cv::Point2d position;  ///< of the anchor, on the base line
  std::string text;      ///< printable ASCII
  double size = 12;      ///< height of a line of text
  Anchor anchor = Anchor::start;
  Colour colour;
  bool upwards = false;  ///< turned by a quarter, to be read from below to above
};

struct Drawing {
  double width = 0, height = 0;
  std::vector<std::variant<Line, Area, Text>> shapes;
};

/// The drawing as an SVG document, the same text for the same drawing.
std::string to_svg(const Drawing& drawing);

inline constexpr double kPictureScale = 2;  ///< of the PNG beside an SVG

/// The drawing on white, `scale` pixels per px. BGR.
cv::Mat3b to_picture(const Drawing& drawing, double scale);

}  // namespace saccade
