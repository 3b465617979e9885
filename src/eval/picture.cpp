#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "eval/drawing.hpp"

namespace saccade {
namespace {

constexpr int kShift = 4;  // positions in sixteenths of a pixel

cv::Scalar bgr(const Colour& colour) {
  return {double(colour.blue), double(colour.green), double(colour.red)};
}

// The parts of a line that a dash pattern leaves, each a line of its own.
std::vector<std::vector<cv::Point2d>> dashes(const Line& line) {
  if (line.dash[0] <= 0) return {line.points};
  std::vector<std::vector<cv::Point2d>> parts;
  bool drawn = true;
  double left = line.dash[0];
  if (!line.points.empty()) parts.push_back({line.points[0]});
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    cv::Point2d from = line.points[i - 1];
    const cv::Point2d to = line.points[i];
    double length = cv::norm(to - from);
    while (length > 0) {
      const double step = std::min(left, length);
      from = step == length ? to : from + (to - from) * (step / length);
      length = cv::norm(to - from);
      if (drawn) parts.back().push_back(from);
      left -= step;
      if (left > 0) continue;
      drawn = !drawn;
      left = line.dash[drawn ? 0 : 1];
      if (drawn) parts.push_back({from});
    }
  }
  return parts;
}

class Painter {
 public:
  Painter(cv::Mat3b& picture, double scale) : picture_(picture), scale_(scale) {}

  void operator()(const Line& line) const {
    for (const auto& part : dashes(line))
      cv::polylines(picture_, fixed(part), false, bgr(line.colour), std::max(1, cvRound(line.width * scale_)),
                    cv::LINE_AA, kShift);
  }

  void operator()(const Area& area) const {
    const auto corners = fixed(area.corners);
    if (area.opacity >= 1) {
      cv::fillPoly(picture_, std::vector{corners}, bgr(area.colour), cv::LINE_AA, kShift);
      return;
    }
    cv::Mat3b over = picture_.clone();
    cv::fillPoly(over, std::vector{corners}, bgr(area.colour), cv::LINE_AA, kShift);
    cv::addWeighted(over, area.opacity, picture_, 1 - area.opacity, 0, picture_);
  }

  void operator()(const Text& text) const {
    constexpr double kCapitals = 0.70, kHersheyCapitals = 21;  // of the size; px at font scale 1
    const double font_scale = text.size * scale_ * kCapitals / kHersheyCapitals;
    const int thickness = std::max(1, cvRound(text.size * scale_ / 18));
    int below = 0;
    const cv::Size box = cv::getTextSize(text.text, cv::FONT_HERSHEY_SIMPLEX, font_scale, thickness, &below);
    const double before = text.anchor == Anchor::start    ? 0.0
                          : text.anchor == Anchor::middle ? box.width / 2.0
                                                          : static_cast<double>(box.width);
    const cv::Point anchor(cvRound(text.position.x * scale_), cvRound(text.position.y * scale_));
    if (!text.upwards) {
      cv::putText(picture_, text.text, {anchor.x - cvRound(before), anchor.y}, cv::FONT_HERSHEY_SIMPLEX,
                  font_scale, bgr(text.colour), thickness, cv::LINE_AA);
      return;
    }
    // Written on a picture that is turned to lie, which is then turned back.
    cv::Mat3b turned;
    cv::rotate(picture_, turned, cv::ROTATE_90_CLOCKWISE);
    cv::putText(turned, text.text, {picture_.rows - 1 - anchor.y - cvRound(before), anchor.x},
                cv::FONT_HERSHEY_SIMPLEX, font_scale, bgr(text.colour), thickness, cv::LINE_AA);
    cv::rotate(turned, picture_, cv::ROTATE_90_COUNTERCLOCKWISE);
  }

 private:
  std::vector<cv::Point> fixed(const std::vector<cv::Point2d>& points) const {
    std::vector<cv::Point> out;
    out.reserve(points.size());
    for (const cv::Point2d& p : points)
      out.emplace_back(cvRound(p.x * scale_ * (1 << kShift)), cvRound(p.y * scale_ * (1 << kShift)));
    return out;
  }

  cv::Mat3b& picture_;
  double scale_;
};

}  // namespace

cv::Mat3b to_picture(const Drawing& drawing, double scale) {
  cv::Mat3b picture(cvRound(drawing.height * scale), cvRound(drawing.width * scale),
                    cv::Vec3b(255, 255, 255));
  const Painter painter(picture, scale);
  for (const auto& shape : drawing.shapes) std::visit(painter, shape);
  return picture;
}

}  // namespace saccade
