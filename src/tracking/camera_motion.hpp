#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

#include "attention/surface_grid.hpp"

namespace cv::rgbd {
struct OdometryFrame;
class Odometry;
}  // namespace cv::rgbd

namespace saccade {

/// The inverse of a rigid motion; cheaper and more exact than that of any matrix.
inline cv::Affine3d inverse(const cv::Affine3d& motion) {
  const cv::Matx33d back = motion.rotation().t();
  return {back, -(back * motion.translation())};
}

/// How the camera has moved up to one frame. Motions map points in mm; a camera frame has x right, y down and
/// z forward, and the world is the camera frame of the first frame after the last cut.
struct CameraStep {
  bool cut = false;               ///< nothing links the frame to the one before it: the world starts again
  cv::Affine3d to_world;          ///< this camera to the world
  cv::Affine3d to_previous;       ///< this camera to that of the frame before; identity after a cut
  cv::Affine3d world_correction;  ///< where a known view is seen again, drift is taken back: places in the
                                  ///< world that the frame before saw move by this; else identity
};

/// Follows a depth camera by dense odometry (OpenCV's rgbd module) on the cells of SurfaceGrid:
/// point-to-plane ICP, and the brightness of the cells too where there is colour.
///
/// Each frame is matched with a *view*: a frame kept from earlier. The error then grows with the number of
/// views, not of frames. When the camera has left its view, the view is replaced by a known one that is seen
/// again, or else by the present frame. A match holds if enough of the view's surface is seen again at the
/// predicted depth. If no view matches, the step is a cut: another scene, a jump, or the odometry has failed.
/// Along a direction that hardly any surface faces (a bare wall, a corridor) depth says nothing of the
/// motion, and the odometry's answer runs away: there the camera is taken to stand still.
///
/// Deterministic: the steps depend on the frames since construction or restart() alone, provided that OpenCV
/// runs on one thread (cv::setNumThreads(1)). OpenCV takes memory for every frame.
/// Thread safety: one call at a time per object.
class CameraMotion {
 public:
  CameraMotion();
  ~CameraMotion();
  CameraMotion(const CameraMotion&) = delete;
  CameraMotion& operator=(const CameraMotion&) = delete;

  /// The step from the frame before. `colour`: H x W of the frame that the grid is built from, BGR; empty =
  /// depth alone. The first frame begins the world without a cut; a frame of another size or camera than the
  /// one before is a cut. A frame with hardly any readings says nothing: the camera is taken to stand still.
  /// after_gap: the source gave nothing for a while, so this may be another scene that shares its large
  /// planes with the last one. Then a view matches only if hardly any surface of the one lies where the other
  /// saw through.
  CameraStep follow(const SurfaceGrid& grid, const cv::Mat3b& colour, bool after_gap = false);

  /// Unit directions in a frame's camera along which its surfaces say nothing, or little, of the motion; at
  /// most two each, and the former among the latter.
  struct Blindness {
    std::vector<cv::Vec3d> unseen, uncertain;
  };

  /// Forgets all views: the next frame is a cut, because the caller knows that the source has jumped.
  void restart();

 private:
  using FramePtr = cv::Ptr<cv::rgbd::OdometryFrame>;

  // A frame that later ones are matched with.
  struct View {
    FramePtr frame;
    cv::Affine3d to_world;
  };

  // Of the cells that a frame and a view both see, if these are enough; else 0.
  struct Agreement {
    double same = 0;     // share that lies at the predicted depth
    double through = 0;  // share that lies where the view saw a farther surface: it was not there
  };

  FramePtr prepare(const SurfaceGrid& grid, const cv::Mat3b& colour) const;
  void set_camera(const SurfaceGrid& grid);
  CameraStep begin(const FramePtr& frame);
  std::optional<cv::Affine3d> relate(const FramePtr& frame, const View& view,
                                     const cv::Affine3d& guess) const;
  std::optional<cv::Affine3d> find(const FramePtr& frame);
  cv::Affine3d believable(const FramePtr& frame, const cv::Affine3d& motion) const;
  cv::Affine3d stand_still(const cv::Affine3d& motion, const cv::Affine3d& before,
                           const std::vector<cv::Vec3d>& directions) const;
  Agreement agreement(const cv::Mat1f& seen_m, const cv::Mat1f& view_m, const cv::Affine3d& to_view) const;
  void change_view(const FramePtr& frame, CameraStep& step);
  std::optional<std::size_t> known_view_near(const cv::Affine3d& to_world) const;

  Intrinsics camera_;  // of the cells
  cv::Size cells_;
  cv::Ptr<cv::rgbd::Odometry> with_colour_, depth_alone_;
  std::vector<View> views_;
  std::size_t view_ = 0;             // the one in use
  cv::Affine3d to_view_, velocity_;  // of the frame before
  Blindness blind_;                  // of the present frame
  bool started_ = false;
  bool after_gap_ = false;  // of the present frame
};

}  // namespace saccade
