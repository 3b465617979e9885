#include "core/frame.hpp"

namespace saccade {
namespace {

void copy_image(const cv::Mat& image, cv::Mat& copy) {
  if (image.empty())
    copy.release();
  else
    image.copyTo(copy);
}

}  // namespace

void copy_frame(const Frame& frame, Frame& copy) {
  copy.index = frame.index;
  copy.timestamp_us = frame.timestamp_us;
  copy.name = frame.name;
  copy.intrinsics = frame.intrinsics;
  copy_image(frame.depth_mm, copy.depth_mm);
  copy_image(frame.colour, copy.colour);
  copy_image(frame.truth.labels, copy.truth.labels);
  copy_image(frame.truth.classes, copy.truth.classes);
  copy_image(frame.truth.normals, copy.truth.normals);
  copy.truth.camera_to_world = frame.truth.camera_to_world;
}

}  // namespace saccade
