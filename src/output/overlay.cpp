#include "output/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

const cv::Scalar kMark(255, 255, 255), kFirstMark(80, 255, 80), kFaintMark(128, 128, 128), kShadow(0, 0, 0);

// Marks and lines grow with the picture: 1 at 640 pixels wide.
double mark_size(const cv::Mat3b& picture) { return std::clamp(picture.cols / 640.0, 0.5, 4.0); }

// The bounding box of each object, with a margin for the closing; one pass over the masks for all objects.
std::vector<cv::Rect> object_boxes(const Attention& attention) {
  constexpr int kRoom = 4;  // twice half the brush
  struct Extent {
    int left = std::numeric_limits<int>::max(), right = -1, top = 0, bottom = -1;
  };
  std::vector<Extent> extents(attention.fixations.size());
  const int width = attention.masks.cols;
  for (int r = 0; r < attention.masks.rows; ++r) {
    const std::uint16_t* ranks = attention.masks[r];
    for (int begin = 0, end = 0; begin < width; begin = end) {  // runs of pixels of one object
      const std::uint16_t rank = ranks[begin];
      while (end < width && ranks[end] == rank) ++end;
      if (rank == 0 || rank > extents.size()) continue;
      Extent& e = extents[rank - 1U];
      if (e.bottom < 0) e.top = r;
      e.bottom = r;
      e.left = std::min(e.left, begin);
      e.right = std::max(e.right, end - 1);
    }
  }
  std::vector<cv::Rect> boxes;
  boxes.reserve(extents.size());
  const cv::Rect whole({}, attention.masks.size());
  for (const Extent& e : extents)
    boxes.push_back(e.bottom < 0 ? cv::Rect()
                                 : cv::Rect(cv::Point(e.left - kRoom, e.top - kRoom),
                                            cv::Point(e.right + 1 + kRoom, e.bottom + 1 + kRoom)) &
                                       whole);
  return boxes;
}

// Doubtful fixations are grey. Frame by frame the first has a colour of its own; over time each object has.
cv::Scalar mark_colour(const Attention& attention, std::size_t index) {
  if (is_doubtful(attention.fixations[index])) return kFaintMark;
  if (attention.sequence) return object_colour(attention.fixations[index].id);
  return index == 0 ? kFirstMark : kMark;
}

void draw_outlines(cv::Mat3b& picture, const Attention& attention) {
  const int line = std::max(1, cvRound(mark_size(picture)));
  for (const Outline& outline : proto_outlines(attention))
    cv::polylines(picture, outline.points, true, mark_colour(attention, outline.rank - 1), line, cv::LINE_AA);
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

void draw_path(cv::Mat3b& picture, const std::vector<Fixation>& fixations) {
  const int line = std::max(1, cvRound(mark_size(picture)));
  for (std::size_t i = 1; i < fixations.size(); ++i)
    cv::line(picture, {fixations[i - 1].col, fixations[i - 1].row}, {fixations[i].col, fixations[i].row},
             is_doubtful(fixations[i]) ? kFaintMark : kMark, line, cv::LINE_AA);
}

// The centre of a mark that is whole inside the picture, so that its number can be read.
cv::Point mark_centre(const cv::Mat3b& picture, const Fixation& fixation, int reach) {
  const auto inside = [&](int place, int length) {
    return length > 2 * reach ? std::clamp(place, reach, length - 1 - reach) : place;
  };
  return {inside(fixation.col, picture.cols), inside(fixation.row, picture.rows)};
}

// Numbered by rank or, over time, by id; with a ring around the object that is looked at.
void draw_marks(cv::Mat3b& picture, const Attention& attention) {
  const std::vector<Fixation>& fixations = attention.fixations;
  const double size = mark_size(picture);
  const int radius = cvRound(11 * size), line = std::max(1, cvRound(size));
  for (std::size_t i = fixations.size(); i-- > 0;) {  // the first on top
    const cv::Point centre = mark_centre(picture, fixations[i], radius + line);
    const cv::Scalar colour = mark_colour(attention, i);
    cv::circle(picture, centre, radius, kShadow, cv::FILLED, cv::LINE_AA);
    cv::circle(picture, centre, radius, colour, line, cv::LINE_AA);
    const bool looked_at = attention.sequence && attention.sequence->gaze == fixations[i].id;
    if (looked_at) cv::circle(picture, centre, cvRound(17 * size), kMark, 2 * line, cv::LINE_AA);
    draw_label(picture, std::to_string(attention.sequence ? fixations[i].id : static_cast<int>(i) + 1),
               centre, size, colour);
  }
}

/// What a pixel with a strength becomes, in units of 1/255: picture * of_picture + of_map, which includes the
/// colour's share and 127 for rounding. Three channels, and one more so that four are copied at once.
struct BlendWeights {
  std::array<std::uint16_t, 4> of_picture, of_map;
};

std::array<BlendWeights, 256> blend_weights(const MapStyle& style) {
  const PaletteColours& colours = colours_of(style.palette);
  std::array<BlendWeights, 256> weights{};
  for (int i = 0; i < 256; ++i) {
    const int a = cvRound(style.opacity * i);
    const auto at = static_cast<std::size_t>(i);
    for (int channel = 0; channel < 3; ++channel) {
      const auto k = static_cast<std::size_t>(channel);
      weights[at].of_picture[k] = static_cast<std::uint16_t>(255 - a);
      weights[at].of_map[k] = static_cast<std::uint16_t>(colours[at][channel] * a + 127);
    }
  }
  return weights;
}

}  // namespace

std::vector<Outline> proto_outlines(const Attention& attention) {
  std::vector<Outline> outlines;
  if (attention.masks.empty()) return outlines;
  const cv::Mat brush = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  const std::vector<cv::Rect> boxes = object_boxes(attention);
  for (std::size_t rank = attention.fixations.size(); rank > 0; --rank) {
    const cv::Rect& box = boxes[rank - 1];
    if (box.empty()) continue;
    cv::Mat1b mask;
    cv::compare(attention.masks(box), static_cast<double>(rank), mask, cv::CMP_EQ);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, brush);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE, box.tl());
    for (auto& points : contours) outlines.push_back({rank, std::move(points)});
  }
  return outlines;
}

cv::Mat1f smooth_for_looking(const cv::Mat1f& saliency) {
  constexpr double kSigmaOfWidth = 1.0 / 200;
  cv::Mat1f smooth;
  cv::GaussianBlur(saliency, smooth, {}, std::max(1.0, saliency.cols * kSigmaOfWidth));
  return smooth;
}

ValueRange shown_range(const cv::Mat1f& smooth, const MapStyle& style) {
  if (style.range) return *style.range;
  double largest = 0;
  cv::minMaxLoc(smooth, nullptr, &largest);
  return {0, static_cast<float>(largest)};
}

cv::Mat1b shown_strength(const cv::Mat1f& smooth, const MapStyle& style) {
  const ValueRange range = shown_range(smooth, style);
  const double low = static_cast<double>(range.low), span = static_cast<double>(range.high) - low;
  if (!(span > 0)) return cv::Mat1b(smooth.size(), std::uint8_t{0});
  cv::Mat1b strength = root_picture(smooth, 1 / span, -low / span);
  if (style.threshold > 0) {
    cv::Mat1f place;
    smooth.convertTo(place, CV_32F, 1 / span, -low / span);
    strength.setTo(0, place < style.threshold);
  }
  return strength;
}

std::optional<ValueRange> shown_depth_range(const Frame& frame, const OverlayStyle& style) {
  if (!frame.colour.empty() && style.background != Background::depth) return std::nullopt;
  return shown_range(frame.depth_mm, style.depth);
}

cv::Mat3b draw_background(const Frame& frame, const OverlayStyle& style) {
  if (frame.colour.empty() || style.background == Background::depth)
    return depth_picture(frame.depth_mm, style.depth);
  return frame.colour.clone();
}

void blend_map(cv::Mat3b& picture, const cv::Mat1b& strength, const MapStyle& style) {
  if (strength.size() != picture.size())
    throw std::invalid_argument("blend_map: picture and map differ in size");
  const std::array<BlendWeights, 256> weights = blend_weights(style);
  const auto width = static_cast<std::size_t>(picture.cols);
  // Of each channel of a row, in arrays of their own, so that the compiler vectorises the arithmetic.
  std::vector<std::uint16_t> of_picture(3 * width + 1), of_map(3 * width + 1);
  for (int r = 0; r < picture.rows; ++r) {
    const std::uint8_t* level = strength[r];
    for (std::size_t c = 0; c < width; ++c) {
      const BlendWeights& w = weights[level[c]];
      std::copy_n(w.of_picture.begin(), 4, &of_picture[3 * c]);  // the next pixel replaces the fourth
      std::copy_n(w.of_map.begin(), 4, &of_map[3 * c]);
    }
    std::uint8_t* p = picture.ptr(r);
    for (std::size_t i = 0; i < 3 * width; ++i) {
      const auto sum = static_cast<std::uint16_t>(p[i] * of_picture[i] + of_map[i]);
      // sum / 255, exact for every sum below 65535.
      p[i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(sum + 1 + (sum >> 8)) >> 8);
    }
  }
}

cv::Scalar object_colour(int id) {
  constexpr double kGoldenTurn = 0.61803398875, kHues = 180;  // OpenCV's hues of 8 bits
  const double turn = id * kGoldenTurn;
  const cv::Mat3b hsv(
      1, 1,
      cv::Vec3b(cv::saturate_cast<std::uint8_t>(std::floor((turn - std::floor(turn)) * kHues)), 170, 255));
  cv::Mat3b bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return {static_cast<double>(bgr(0, 0)[0]), static_cast<double>(bgr(0, 0)[1]),
          static_cast<double>(bgr(0, 0)[2])};
}

void draw_attention(cv::Mat3b& picture, const Attention& attention, const OverlayStyle& style) {
  if (style.outlines) draw_outlines(picture, attention);
  if (style.path && !attention.sequence) draw_path(picture, attention.fixations);
  if (style.marks) draw_marks(picture, attention);
}

cv::Mat3b draw_overlay(const Frame& frame, const cv::Mat1f& saliency, const Attention& attention,
                       const OverlayStyle& style) {
  cv::Mat3b picture = draw_background(frame, style);
  if (style.map.opacity > 0)
    blend_map(picture, shown_strength(smooth_for_looking(saliency), style.map), style.map);
  draw_attention(picture, attention, style);
  return picture;
}

}  // namespace saccade
