#include "ui/overlay.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "ui/colour_map.hpp"

namespace saccade {
namespace {

const cv::Scalar kMark(255, 255, 255), kFirstMark(80, 255, 80), kShadow(0, 0, 0);

// Marks and lines grow with the picture: 1 at 640 pixels wide.
double mark_size(const cv::Mat3b& picture) { return std::clamp(picture.cols / 640.0, 0.5, 4.0); }

// The map as it is looked at: its lines are a pixel or two wide, so it is smoothed, and scaled to 0..1 after
// that.
cv::Mat1f heat(const cv::Mat1f& saliency) {
  constexpr double kSigmaOfWidth = 1.0 / 200;
  cv::Mat1f smooth;
  cv::GaussianBlur(saliency, smooth, {}, std::max(1.0, saliency.cols * kSigmaOfWidth));
  double largest = 0;
  cv::minMaxLoc(smooth, nullptr, &largest);
  return largest > 0 ? cv::Mat1f(smooth / largest) : smooth;
}

// out = background * (1 - a) + turbo(v) * a with v = sqrt(heat) and a = opacity * v, so that the unsalient
// stays as it was and the weak is seen beside the strong.
void blend_map(cv::Mat3b& picture, const cv::Mat1f& saliency, double opacity) {
  cv::Mat1f shown;
  cv::sqrt(heat(saliency), shown);
  cv::Mat1b level;
  shown.convertTo(level, CV_8U, 255);
  cv::Mat3b colours;
  cv::applyColorMap(level, colours, cv::COLORMAP_TURBO);
  for (int r = 0; r < picture.rows; ++r)
    for (int c = 0; c < picture.cols; ++c) {
      const int a = cvRound(opacity * level(r, c));
      cv::Vec3b& p = picture(r, c);
      const cv::Vec3b& q = colours(r, c);
      for (int i = 0; i < 3; ++i) p[i] = static_cast<std::uint8_t>((p[i] * (255 - a) + q[i] * a + 127) / 255);
    }
}

// The outer contour of each proto-object; pixels without depth inside it are not drawn as holes.
void draw_outlines(cv::Mat3b& picture, const Attention& attention) {
  if (attention.masks.empty()) return;
  const double size = mark_size(picture);
  const cv::Mat brush = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  for (std::size_t rank = attention.fixations.size(); rank > 0; --rank) {
    cv::Mat1b mask;
    cv::compare(attention.masks, static_cast<double>(rank), mask, cv::CMP_EQ);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, brush);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
    cv::drawContours(picture, contours, -1, rank == 1 ? kFirstMark : kMark, std::max(1, cvRound(size)),
                     cv::LINE_AA);
  }
}

void draw_label(cv::Mat3b& picture, const std::string& text, cv::Point centre, double size,
                const cv::Scalar& colour) {
  int baseline = 0;
  const double scale = 0.45 * size;
  const cv::Size box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &baseline);
  const cv::Point origin(centre.x - box.width / 2, centre.y + box.height / 2);
  cv::putText(picture, text, origin, cv::FONT_HERSHEY_SIMPLEX, scale, colour, std::max(1, cvRound(size)),
              cv::LINE_AA);
}

void draw_marks(cv::Mat3b& picture, const std::vector<Fixation>& fixations) {
  const double size = mark_size(picture);
  const int radius = cvRound(11 * size), line = std::max(1, cvRound(size));
  for (std::size_t i = 1; i < fixations.size(); ++i)
    cv::line(picture, {fixations[i - 1].col, fixations[i - 1].row}, {fixations[i].col, fixations[i].row},
             kMark, line, cv::LINE_AA);
  for (std::size_t i = fixations.size(); i-- > 0;) {  // the first on top
    const cv::Point centre(fixations[i].col, fixations[i].row);
    const cv::Scalar& colour = i == 0 ? kFirstMark : kMark;
    cv::circle(picture, centre, radius, kShadow, cv::FILLED, cv::LINE_AA);
    cv::circle(picture, centre, radius, colour, line, cv::LINE_AA);
    draw_label(picture, std::to_string(i + 1), centre, size, colour);
  }
}

}  // namespace

cv::Mat3b draw_overlay(const Frame& frame, const cv::Mat1f& saliency, const Attention& attention,
                       const OverlayStyle& style) {
  cv::Mat3b picture = frame.colour.empty() ? depth_picture(frame.depth_mm) : cv::Mat3b(frame.colour.clone());
  blend_map(picture, saliency, style.map_opacity);
  if (style.outlines) draw_outlines(picture, attention);
  if (style.marks) draw_marks(picture, attention.fixations);
  return picture;
}

}  // namespace saccade
