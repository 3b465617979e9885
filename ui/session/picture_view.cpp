#include "ui/session/picture_view.hpp"

#include <algorithm>

namespace saccade {

void PictureView::layout(cv::Size2d panel, cv::Size2d picture) {
  panel_ = {std::max(panel.width, 1.0), std::max(panel.height, 1.0)};
  if (picture != picture_) fitted_ = true;
  picture_ = {std::max(picture.width, 1.0), std::max(picture.height, 1.0)};
  if (fitted_) {
    scale_ = fitting_scale();
    centre_ = {picture_.width / 2, picture_.height / 2};
  }
}

void PictureView::zoom(double factor, cv::Point2d about) {
  const cv::Point2d held = to_picture(about);
  const double smallest = std::min(fitting_scale(), 1.0) / 2;
  scale_ = std::clamp(scale_ * factor, smallest, kLargestZoom);
  centre_ = held - (about - panel_centre()) / scale_;
  fitted_ = false;
  keep_in_sight();
}

void PictureView::pan(cv::Point2d drag) {
  centre_ -= drag / scale_;
  fitted_ = false;
  keep_in_sight();
}

void PictureView::centre_on(cv::Point2d picture) {
  if (fitted_) scale_ = std::min(2 * fitting_scale(), kLargestZoom);
  fitted_ = false;
  centre_ = picture;
  keep_in_sight();
}

cv::Point2d PictureView::inside(cv::Point2d point, double margin) const {
  const cv::Point2d low = to_panel({0, 0}), high = to_panel({picture_.width, picture_.height});
  const auto along = [&](double place, double from, double to) {
    return to - from > 2 * margin ? std::clamp(place, from + margin, to - margin) : place;
  };
  return {along(point.x, low.x, high.x), along(point.y, low.y, high.y)};
}

double PictureView::fitting_scale() const {
  return std::min({panel_.width / picture_.width, panel_.height / picture_.height, kLargestZoom});
}

// The middle of the panel stays on the picture.
void PictureView::keep_in_sight() {
  centre_.x = std::clamp(centre_.x, 0.0, picture_.width);
  centre_.y = std::clamp(centre_.y, 0.0, picture_.height);
}

}  // namespace saccade
