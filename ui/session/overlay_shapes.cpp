#include "ui/session/overlay_shapes.hpp"

namespace saccade {
namespace {

constexpr Rgba kRest{255, 255, 255, 235}, kFirst{88, 255, 120, 255}, kFaint{255, 255, 255, 110},
    kShadow{0, 0, 0, 150};

// `rank` from 1.
Rgba colour_of(const std::vector<Fixation>& fixations, std::size_t rank) {
  if (is_doubtful(fixations[rank - 1])) return kFaint;
  return rank == 1 ? kFirst : kRest;
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

}  // namespace

OverlayShapes overlay_shapes(const Computed& computed, const OverlayStyle& style, const PictureView& view,
                             double unit) {
  OverlayShapes shapes;
  const auto width = static_cast<float>(1.4 * unit);
  const auto& fixations = computed.result.attention.fixations;
  if (style.outlines)
    for (const Outline& outline : computed.outlines) {
      std::vector<cv::Point2f> points;
      points.reserve(outline.points.size());
      for (const cv::Point& p : outline.points) points.push_back(place(view, p.x, p.y));
      add_line(shapes, std::move(points), true, width, colour_of(fixations, outline.rank));
    }
  if (style.path && fixations.size() > 1) {
    std::vector<cv::Point2f> path;
    path.reserve(fixations.size());
    for (const Fixation& f : fixations) path.push_back(place(view, f.col, f.row));
    add_line(shapes, std::move(path), false, width, {255, 255, 255, 190});
  }
  if (style.marks)
    for (std::size_t i = fixations.size(); i-- > 0;)
      shapes.marks.push_back({place(view, fixations[i].col, fixations[i].row), static_cast<float>(10 * unit),
                              colour_of(fixations, i + 1), std::to_string(i + 1)});
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
