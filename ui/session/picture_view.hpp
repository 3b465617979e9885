#pragma once

#include <opencv2/core.hpp>

namespace saccade {

/// Zoom and pan of a picture in a panel. Points of the panel are in its own pixels from its top-left corner;
/// points of the picture are continuous, pixel (r, c) covers c..c+1, r..r+1.
class PictureView {
 public:
  static constexpr double kLargestZoom = 64;  ///< panel pixels per pixel of the picture

  /// Shows the whole picture, as large as it fits, in the middle; a new view does too.
  void fit() { fitted_ = true; }
  bool fitted() const { return fitted_; }

  /// Sets the sizes of both; a fitted view follows, another keeps its centre and zoom.
  void layout(cv::Size2d panel, cv::Size2d picture);

  /// Zooms by `factor`; the point under `about` stays there.
  void zoom(double factor, cv::Point2d about);
  void pan(cv::Point2d drag);
  /// Shows this point of the picture in the middle, enlarged if the whole picture was shown.
  void centre_on(cv::Point2d picture);

  double scale() const { return scale_; }  ///< panel pixels per pixel of the picture
  cv::Point2d to_panel(cv::Point2d picture) const { return panel_centre() + (picture - centre_) * scale_; }
  /// The point of the panel that is nearest to `point` and at least `margin` inside the picture's edges;
  /// along an axis that has no room for that, where it is.
  cv::Point2d inside(cv::Point2d point, double margin) const;
  cv::Point2d to_picture(cv::Point2d panel) const { return centre_ + (panel - panel_centre()) / scale_; }

 private:
  cv::Point2d panel_centre() const { return {panel_.width / 2, panel_.height / 2}; }
  double fitting_scale() const;
  void keep_in_sight();

  cv::Size2d panel_{1, 1}, picture_{1, 1};
  cv::Point2d centre_{0.5, 0.5};  // of the visible part, in the picture
  double scale_ = 1;
  bool fitted_ = true;
};

}  // namespace saccade
