#include "ui/session/overlay_shapes.hpp"

namespace saccade {
namespace {

constexpr Rgba kRest{255, 255, 255, 235}, kFirst{88, 255, 120, 255}, kFaint{255, 255, 255, 110},
    kShadow{0, 0, 0, 150};
constexpr std::uint8_t kFresh = 255, kAttended = 150;  // opacity of objects over time

// `rank` from 1.
Rgba colour_of(const Computed& computed, std::size_t rank) {
  const Fixation& fixation = computed.result.attention.fixations[rank - 1];
  if (is_doubtful(fixation)) return kFaint;
  if (!computed.marks) return rank == 1 ? kFirst : kRest;
  const cv::Scalar bgr = object_colour(fixation.id);
  const auto byte = [&](int i) { return cv::saturate_cast<std::uint8_t>(bgr[i]); };
  return {byte(2), byte(1), byte(0), computed.marks->marks[rank - 1].attended ? kAttended : kFresh};
}

cv::Point2f place(const PictureView& view, double col, double row) {
  // The middle of a pixel is half a pixel from its corner.
  return view.to_panel({col + 0.5, row + 0.5});
}

// A light line on a dark one is visible on any picture.
void add_line(OverlayShapes& shapes, std::vector<cv::Point2f> points, bool closed, float width, Rgba colour) {
  shapes.lines.push_back({points, closed, width + 1.5F, kShadow});
  shapes.lines.push_back({std::move(points), closed, width, colour});
}

// Where the mark of a fixation stands. Over time that is between pixels.
cv::Point2f mark_place(const PictureView& view, const Computed& computed, std::size_t index) {
  if (computed.marks) return view.to_panel(computed.marks->marks[index].place);
  const Fixation& fixation = computed.result.attention.fixations[index];
  return place(view, fixation.col, fixation.row);
}

// From fixation to fixation or, over time, where the gaze was; its older parts are fainter.
void add_path(OverlayShapes& shapes, const Computed& computed, const PictureView& view, float width) {
  std::vector<cv::Point2f> path;
  if (!computed.marks) {
    path.reserve(computed.result.attention.fixations.size());
    for (std::size_t i = 0; i < computed.result.attention.fixations.size(); ++i)
      path.push_back(mark_place(view, computed, i));
    if (path.size() > 1) add_line(shapes, std::move(path), false, width, {255, 255, 255, 190});
    return;
  }
  path.reserve(computed.marks->trail.size());
  for (const cv::Point2d& p : computed.marks->trail) path.push_back(view.to_panel(p));
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto opacity = static_cast<std::uint8_t>(210 * i / (path.size() - 1));
    shapes.lines.push_back({{path[i - 1], path[i]}, false, width, {255, 255, 255, opacity}});
  }
}

}  // namespace

OverlayShapes overlay_shapes(const Computed& computed, const OverlayStyle& style, const PictureView& view,
                             double unit) {
  OverlayShapes shapes;
  const auto width = static_cast<float>(1.4 * unit);
  const Attention& attention = computed.result.attention;
  if (style.outlines)
    for (const Outline& outline : computed.outlines) {
      std::vector<cv::Point2f> points;
      points.reserve(outline.points.size());
      for (const cv::Point& p : outline.points) points.push_back(place(view, p.x, p.y));
      add_line(shapes, std::move(points), true, width, colour_of(computed, outline.rank));
    }
  if (style.path) add_path(shapes, computed, view, width);
  if (!style.marks) return shapes;
  for (std::size_t i = attention.fixations.size(); i-- > 0;) {
    const auto radius = static_cast<float>(10 * unit);
    // Whole, so that its number can be read.
    const cv::Point2f centre =
        view.inside(mark_place(view, computed, i), static_cast<double>(radius + width));
    const std::string text =
        std::to_string(computed.marks ? attention.fixations[i].id : static_cast<int>(i) + 1);
    shapes.marks.push_back({centre, radius, colour_of(computed, i + 1), text});
    if (computed.marks && attention.sequence->gaze == attention.fixations[i].id)
      shapes.rings.push_back({centre, static_cast<float>(16 * unit), 1.6F * width, kRest});
  }
  return shapes;
}

int mark_under(const OverlayShapes& shapes, cv::Point2d pointer) {
  for (std::size_t i = shapes.marks.size(); i-- > 0;) {
    const OverlayShapes::Mark& mark = shapes.marks[i];
    if (cv::norm(cv::Point2d(mark.centre) - pointer) <= static_cast<double>(mark.radius))
      return static_cast<int>(shapes.marks.size() - 1 - i);
  }
  return -1;
}

}  // namespace saccade
