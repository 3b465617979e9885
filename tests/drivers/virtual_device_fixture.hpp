#pragma once

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "openni_device.hpp"
#include "sources/open_source.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {

/// The virtual device, through OpenNI2 as any program would use it. Each test starts OpenNI2 again, with the
/// device and the faults that it asks for.
class VirtualDeviceTest : public OpenNiTest {
 protected:
  static constexpr const char* kScene = "synthetic:table?seed=3&noise=kinect&size=160x120&frames=7";
  static constexpr const char* kUri = "saccade-virtual://0";

  ~VirtualDeviceTest() override { ::unsetenv("SACCADE_VIRTUAL_DEVICE"); }

  static void offer(const std::string& text) {
    ::setenv("SACCADE_VIRTUAL_DEVICE", text.c_str(), 1);
    start();
  }
  static void offer_scene(const std::string& faults = "") {
    offer(std::string(kScene) + "&rate=200" + faults);
  }

  /// Opens the device that is offered and both of its streams.
  void open() {
    ASSERT_EQ(device_.open(openni::ANY_DEVICE), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
    depth_.emplace(device_, openni::SENSOR_DEPTH);
    colour_.emplace(device_, openni::SENSOR_COLOR);
  }
  void open_scene(const std::string& faults = "") {
    offer_scene(faults);
    open();
  }
  /// Opens the device, with depth that streams.
  void stream_depth(const std::string& faults = "") {
    open_scene(faults);
    ASSERT_EQ((*depth_)->start(), openni::STATUS_OK);
  }
  void stream_both(const std::string& faults = "") {
    stream_depth(faults);
    ASSERT_EQ((*colour_)->start(), openni::STATUS_OK);
  }
  void close() {
    depth_.reset();
    colour_.reset();
    device_.close();
  }

  /// The frame of the scene that a frame of the device should show.
  const Frame& original(const SeenFrame& seen) const {
    return frames_.at(static_cast<std::size_t>(seen.index - 1) % frames_.size());
  }

  openni::Device device_;
  std::optional<SeenStream> depth_, colour_;

 private:
  static std::vector<Frame> read_scene() {
    std::vector<Frame> frames;
    const auto source = open_source(kScene);
    Frame frame;
    while (source->read(frame, kNoWait).status == ReadStatus::frame) {
      frames.push_back(frame);
      frames.back().depth_mm = frame.depth_mm.clone();
    }
    return frames;
  }

  const std::vector<Frame> frames_ = read_scene();
};

inline bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const cv::Mat joined_a = a.isContinuous() ? a : a.clone(), joined_b = b.isContinuous() ? b : b.clone();
  return std::memcmp(joined_a.data, joined_b.data, joined_a.total() * joined_a.elemSize()) == 0;
}

/// The device's expected output for a frame, by the simplest code; with `step` 2 in a mode of half the size.
inline cv::Mat1w depth_of(const Frame& frame, int step = 1) {
  cv::Mat1w depth(frame.size() / step);
  for (int row = 0; row < depth.rows; ++row)
    for (int column = 0; column < depth.cols; ++column)
      depth(row, column) = static_cast<std::uint16_t>(std::lround(frame.depth_mm(step * row, step * column)));
  return depth;
}

inline cv::Mat3b colour_of(const Frame& frame, int step = 1) {
  cv::Mat3b rgb(frame.size() / step);
  for (int row = 0; row < rgb.rows; ++row)
    for (int column = 0; column < rgb.cols; ++column) {
      const cv::Vec3b bgr = frame.colour(step * row, step * column);
      rgb(row, column) = {bgr[2], bgr[1], bgr[0]};
    }
  return rgb;
}

}  // namespace saccade
