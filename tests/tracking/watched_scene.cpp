#include "watched_scene.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene/random.hpp"

namespace saccade {
namespace {

constexpr double kRateHz = 30;

cv::Affine3d as_affine(const scene::Pose& pose) {
  cv::Matx33d rotation;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) rotation(r, c) = pose.rotation(r, c);
  return {rotation, cv::Vec3d(pose.position_mm.x(), pose.position_mm.y(), pose.position_mm.z())};
}

}  // namespace

WatchedScene::WatchedScene(const Options& options)
    : options_(options),
      scene_(scene::make_scene(options.scene, {options.seed, {}, {}})),
      event_(scene::plan_event(scene_, options.event, options.at_s, options.seed)) {
  const double focal = 525.0 * options.size.width / 640;
  frame_.intrinsics = {focal, focal, (options.size.width - 1) / 2.0, (options.size.height - 1) / 2.0,
                       IntrinsicsOrigin::sensor};
}

const Frame& WatchedScene::frame(std::int64_t k) {
  const double time_s = static_cast<double>(k) / kRateHz;
  const scene::Pose pose = scene::camera_on(scene_, options_.camera, time_s);
  scene::render(scene::scene_at(scene_, event_, time_s), frame_.intrinsics, options_.size, pose, view_);
  frame_.index = k;
  frame_.timestamp_us = std::llround(time_s * 1e6);
  view_.colour.copyTo(frame_.colour);
  view_.labels.copyTo(frame_.truth.labels);
  frame_.truth.camera_to_world = as_affine(pose);
  if (options_.noise) {
    kinect_.set_view(view_, frame_.intrinsics);
    kinect_.sense(scene::mix(options_.seed, static_cast<std::uint64_t>(k)), frame_.depth_mm);
  } else {
    view_.depth_mm.copyTo(frame_.depth_mm);
  }
  return frame_;
}

cv::Mat1f WatchedScene::saliency(float step, double jitter) const {
  const cv::Mat1w& labels = frame_.truth.labels;
  cv::Mat1f map(labels.size(), 0.0F);
  scene::Random random(static_cast<std::uint64_t>(frame_.index));
  for (int label = 1; label <= scene_.objects + 1; ++label) {
    const double height = (1 + static_cast<double>(step) * label) * (1 + random.between(-jitter, jitter));
    cv::Mat1b mask;
    cv::compare(labels, label, mask, cv::CMP_EQ);
    const cv::Moments moments = cv::moments(mask, true);
    if (moments.m00 < 20) continue;
    const double col = moments.m10 / moments.m00, row = moments.m01 / moments.m00,
                 sigma = 0.35 * std::sqrt(moments.m00);
    for (int r = 0; r < map.rows; ++r)
      for (int c = 0; c < map.cols; ++c) {
        const double square = (r - row) * (r - row) + (c - col) * (c - col);
        map(r, c) = std::max(map(r, c), static_cast<float>(height * std::exp(-square / (2 * sigma * sigma))));
      }
  }
  return map;
}

}  // namespace saccade
