#include "tracking/camera_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <opencv2/imgproc.hpp>
#include <opencv2/rgbd/depth.hpp>

#include "tracking/cell_projection.hpp"

namespace saccade {
namespace {

using cv::rgbd::OdometryFrame;

constexpr float kMetre = 1e-3F;

// Of the odometry. More iterations or points, or cells half as large, gain nothing on real video.
constexpr float kNearest_m = 0, kFarthest_m = 8;
constexpr float kReach_m = 0.07F;        // pairs of points farther apart are no pairs
constexpr float kPointShare = 0.07F;     // of the cells
constexpr float kFaintestGradient = 10;  // of the brightness, grey levels; fainter cells are not used
const std::vector<int> kIterations = {4, 4, 4, 4};  // from the finest of four pyramid levels on

// A match is believed in this range only, and only if at least kAgreement of the cells that both see, and
// those are kOverlap of the frame's, lie at the predicted depth.
constexpr double kMostShift_m = 0.6, kMostTurn_degrees = 40;
constexpr double kAgreement = 0.6, kOverlap = 0.3;

// After a gap a match is believed only if no more than this share of the cells of frame and view, the two
// shares added, lies where the other sees through. The same scene has up to .045, another table .12 and more.
constexpr double kMostThrough = 0.06;

// Share of the scatter of normals below which the motion along a direction is unseen, or uncertain. An
// uncertain motion is doubted if it is larger than kDoubted_mm.
constexpr double kUnseen = 0.01, kUncertain = 0.03, kDoubted_mm = 30;

// A view is left beyond these.
constexpr double kViewShift_mm = 150, kViewTurn_rad = 12 * std::numbers::pi / 180;
constexpr std::size_t kMostViews = 32, kViewsTried = 4;

double turn_rad(const cv::Affine3d& motion) { return cv::norm(motion.rvec()); }

// 0 = the same pose; 1 = as far as a view is used.
double distance(const cv::Affine3d& motion) {
  return std::max(cv::norm(motion.translation()) / kViewShift_mm, turn_rad(motion) / kViewTurn_rad);
}

cv::Matx44d in_metres(cv::Affine3d motion) {
  motion.translation(motion.translation() * static_cast<double>(kMetre));
  return motion.matrix;
}

// The odometry multiplies small rotations, whose errors add up; through its axis the rotation becomes one
// again.
cv::Affine3d in_mm(const cv::Mat& matrix) {
  const cv::Affine3d motion{cv::Matx44d(matrix)};
  return {motion.rvec(), motion.translation() / static_cast<double>(kMetre)};
}

cv::Mat camera_matrix(const Intrinsics& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

bool is_blank(const SurfaceGrid& grid) {
  constexpr double kFewest = 0.05;  // of the cells
  const auto valid =
      std::count_if(grid.depth_mm().begin(), grid.depth_mm().end(), [](float z) { return z > 0; });
  return static_cast<double>(valid) < kFewest * static_cast<double>(grid.size());
}

// The directions along which the normals are hardly scattered: eigenvectors of the mean of n n', by what
// share of it lies along them.
CameraMotion::Blindness measure_blindness(const SurfaceGrid& grid) {
  cv::Matx33d scatter;
  int count = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.normal_z()[i] == 0) continue;
    const cv::Vec3d normal(static_cast<double>(grid.normal_x()[i]), static_cast<double>(grid.normal_y()[i]),
                           static_cast<double>(grid.normal_z()[i]));
    scatter += normal * normal.t();
    ++count;
  }
  cv::Vec3d values;
  cv::Matx33d vectors;  // rows
  cv::eigen(scatter, values, vectors);
  CameraMotion::Blindness blindness;
  for (int k = 1; k < 3; ++k) {
    const cv::Vec3d direction(vectors(k, 0), vectors(k, 1), vectors(k, 2));
    if (values[k] < kUnseen * count) blindness.unseen.push_back(direction);
    if (values[k] < kUncertain * count) blindness.uncertain.push_back(direction);
  }
  return blindness;
}

bool same_camera(const Intrinsics& a, const Intrinsics& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

}  // namespace

CameraMotion::CameraMotion() = default;
CameraMotion::~CameraMotion() = default;

CameraStep CameraMotion::follow(const SurfaceGrid& grid, const cv::Mat3b& colour, bool after_gap) {
  const cv::Size cells(grid.cols(), grid.rows());
  if (cells != cells_ || !same_camera(grid.camera(), camera_)) {
    cells_ = cells;
    set_camera(grid);
    views_.clear();
  }
  if (is_blank(grid)) {
    CameraStep still;
    if (!views_.empty()) still.to_world = views_[view_].to_world * to_view_;
    velocity_ = cv::Affine3d::Identity();
    return still;
  }
  const FramePtr frame = prepare(grid, colour);
  after_gap_ = after_gap;
  blind_ = measure_blindness(grid);
  if (views_.empty()) return begin(frame);
  const cv::Affine3d before = to_view_;
  const std::size_t view_before = view_;
  const auto to_view = find(frame);
  if (!to_view) {
    views_.clear();
    return begin(frame);
  }
  CameraStep step;
  step.to_world = views_[view_].to_world * *to_view;
  step.to_previous = inverse(views_[view_before].to_world * before) * step.to_world;
  velocity_ = view_ == view_before ? inverse(before) * *to_view : cv::Affine3d::Identity();
  to_view_ = *to_view;
  if (distance(to_view_) > 1) change_view(frame, step);
  return step;
}

void CameraMotion::restart() { views_.clear(); }

void CameraMotion::set_camera(const SurfaceGrid& grid) {
  camera_ = grid.camera();
  const cv::Mat matrix = camera_matrix(camera_);
  const std::vector<float> gradients(kIterations.size(), kFaintestGradient);
  const auto icp =
      cv::rgbd::ICPOdometry::create(matrix, kNearest_m, kFarthest_m, kReach_m, kPointShare, kIterations);
  const auto both = cv::rgbd::RgbdICPOdometry::create(matrix, kNearest_m, kFarthest_m, kReach_m, kPointShare,
                                                      kIterations, gradients);
  icp->setMaxTranslation(kMostShift_m);
  icp->setMaxRotation(kMostTurn_degrees);
  both->setMaxTranslation(kMostShift_m);
  both->setMaxRotation(kMostTurn_degrees);
  depth_alone_ = icp;
  with_colour_ = both;
}

// The normals of the grid would spare OpenCV its own, but with them the motion is lost: they are too smooth.
CameraMotion::FramePtr CameraMotion::prepare(const SurfaceGrid& grid, const cv::Mat3b& colour) const {
  cv::Mat1f depth_m(cells_);
  cv::Mat1b valid(cells_);
  for (int i = 0; i < static_cast<int>(grid.size()); ++i) {
    const float z = grid.depth_mm()[static_cast<std::size_t>(i)];
    const int row = i / cells_.width, col = i % cells_.width;
    depth_m(row, col) = z > 0 ? z * kMetre : std::numeric_limits<float>::quiet_NaN();
    valid(row, col) = z > 0 ? 255 : 0;
  }
  cv::Mat grey;
  if (!colour.empty()) {
    cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
    cv::resize(grey, grey, cells_, 0, 0, cv::INTER_AREA);
  }
  FramePtr frame = OdometryFrame::create(grey, depth_m, valid);
  (grey.empty() ? depth_alone_ : with_colour_)->prepareFrameCache(frame, OdometryFrame::CACHE_ALL);
  return frame;
}

CameraStep CameraMotion::begin(const FramePtr& frame) {
  CameraStep step;
  step.cut = started_;
  started_ = true;
  views_.push_back({frame, {}});
  view_ = 0;
  to_view_ = velocity_ = cv::Affine3d::Identity();
  return step;
}

// The motion from the frame's camera to that of a known view, which becomes the one in use.
std::optional<cv::Affine3d> CameraMotion::find(const FramePtr& frame) {
  for (const cv::Affine3d& guess : {to_view_ * velocity_, to_view_})
    if (const auto motion = relate(frame, views_[view_], guess)) return believable(frame, *motion);
  const cv::Affine3d last = views_[view_].to_world * to_view_;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < views_.size(); ++i)
    if (i != view_) others.push_back(i);
  const auto nearer = [&](std::size_t a, std::size_t b) {
    return distance(inverse(views_[a].to_world) * last) < distance(inverse(views_[b].to_world) * last);
  };
  std::sort(others.begin(), others.end(), nearer);
  others.resize(std::min(others.size(), kViewsTried));
  for (const std::size_t other : others)
    if (const auto motion = relate(frame, views_[other], cv::Affine3d::Identity())) {
      view_ = other;
      return motion;
    }
  return std::nullopt;
}

std::optional<cv::Affine3d> CameraMotion::relate(const FramePtr& frame, const View& view,
                                                 const cv::Affine3d& guess) const {
  const bool colour = !frame->image.empty() && !view.frame->image.empty();
  FramePtr from = frame, to = view.frame;
  cv::Mat motion;
  if (!(colour ? with_colour_ : depth_alone_)->compute(from, to, motion, cv::Mat(in_metres(guess))))
    return std::nullopt;
  const cv::Affine3d to_view = in_mm(motion);
  const Agreement there = agreement(frame->depth, view.frame->depth, to_view);
  if (there.same < kAgreement) return std::nullopt;
  if (after_gap_ &&
      there.through + agreement(view.frame->depth, frame->depth, inverse(to_view)).through > kMostThrough)
    return std::nullopt;
  return to_view;
}

// The motion to the view in use, without what depth says nothing of. A large motion along an uncertain
// direction is believed only if it predicts the depth better than standing still does.
cv::Affine3d CameraMotion::believable(const FramePtr& frame, const cv::Affine3d& motion) const {
  const cv::Affine3d seen = stand_still(motion, to_view_, blind_.unseen);
  const cv::Affine3d certain = stand_still(motion, to_view_, blind_.uncertain);
  if (cv::norm(seen.translation() - certain.translation()) <= kDoubted_mm) return seen;
  const cv::Mat1f there = views_[view_].frame->depth;
  return agreement(frame->depth, there, seen).same > agreement(frame->depth, there, certain).same ? seen
                                                                                                  : certain;
}

// The motion without its part along some directions of the frame's camera. If these are two, one plane is
// seen, and its normal is also an axis about which the camera may turn unseen.
cv::Affine3d CameraMotion::stand_still(const cv::Affine3d& motion, const cv::Affine3d& before,
                                       const std::vector<cv::Vec3d>& directions) const {
  cv::Matx33d rotation = motion.rotation();
  if (directions.size() == 2) {
    const cv::Vec3d axis = directions[0].cross(directions[1]);
    const cv::Vec3d turn = cv::Affine3d(before.rotation().t() * rotation).rvec();
    rotation = before.rotation() * cv::Affine3d(cv::Vec3d(turn - axis * axis.dot(turn))).rotation();
  }
  cv::Vec3d shift = motion.translation() - before.translation();
  for (const cv::Vec3d& direction : directions) {
    const cv::Vec3d in_view = rotation * direction;
    shift -= in_view * in_view.dot(shift);
  }
  return {rotation, before.translation() + shift};
}

// Every fourth cell.
CameraMotion::Agreement CameraMotion::agreement(const cv::Mat1f& seen_m, const cv::Mat1f& view_m,
                                                const cv::Affine3d& to_view) const {
  constexpr int kEvery = 2;
  const cv::Matx44d motion = in_metres(to_view);
  int valid = 0, both = 0, same = 0, through = 0;
  for (int r = 0; r < seen_m.rows; r += kEvery)
    for (int c = 0; c < seen_m.cols; c += kEvery) {
      const double z = static_cast<double>(seen_m(r, c));
      if (!(z > 0)) continue;
      ++valid;
      const cv::Vec4d q =
          motion * cv::Vec4d((c - camera_.cx) / camera_.fx * z, (r - camera_.cy) / camera_.fy * z, z, 1);
      if (!(q[2] > 0)) continue;
      const int col = cvRound(camera_.fx * q[0] / q[2] + camera_.cx),
                row = cvRound(camera_.fy * q[1] / q[2] + camera_.cy);
      if (row < 0 || col < 0 || row >= view_m.rows || col >= view_m.cols) continue;
      const double there = static_cast<double>(view_m(row, col));
      if (!(there > 0)) continue;
      ++both;
      const double farther = there - q[2], reach = kSameDepth * q[2];
      same += std::abs(farther) <= reach;
      through += farther > reach;
    }
  if (both < kOverlap * valid || both == 0) return {};
  return {static_cast<double>(same) / both, static_cast<double>(through) / both};
}

// The view is left: a known one that is seen again takes its place, or else this frame does.
void CameraMotion::change_view(const FramePtr& frame, CameraStep& step) {
  if (const auto known = known_view_near(step.to_world)) {
    const View& view = views_[*known];
    if (const auto motion = relate(frame, view, inverse(view.to_world) * step.to_world)) {
      const cv::Affine3d corrected = view.to_world * *motion;
      step.world_correction = corrected * inverse(step.to_world);
      step.to_world = corrected;
      view_ = *known;
      to_view_ = *motion;
      return;
    }
  }
  if (views_.size() == kMostViews) views_.erase(views_.begin());
  views_.push_back({frame, step.to_world});
  view_ = views_.size() - 1;
  to_view_ = cv::Affine3d::Identity();
}

std::optional<std::size_t> CameraMotion::known_view_near(const cv::Affine3d& to_world) const {
  constexpr double kNear = 0.7;  // so near that it will be in use for a while
  std::optional<std::size_t> nearest;
  double best = kNear;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const double away = distance(inverse(views_[i].to_world) * to_world);
    if (i == view_ || away >= best) continue;
    best = away;
    nearest = i;
  }
  return nearest;
}

}  // namespace saccade
