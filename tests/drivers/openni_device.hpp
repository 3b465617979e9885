#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <OpenNI.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace saccade {

/// Longer than anything takes on a machine that works.
inline constexpr std::chrono::seconds kGenerous{30};

/// OpenNI2, started for one test and shut down at its end.
class OpenNiTest : public ::testing::Test {
 protected:
  ~OpenNiTest() override { openni::OpenNI::shutdown(); }

  static void start() {
    ASSERT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
  }

  static std::vector<std::string> uris() {
    openni::Array<openni::DeviceInfo> list;
    openni::OpenNI::enumerateDevices(&list);
    std::vector<std::string> found;
    for (int i = 0; i < list.getSize(); ++i) found.emplace_back(list[i].getUri());
    return found;
  }
};

/// A frame of a device, copied.
struct SeenFrame {
  int index = 0;
  std::uint64_t timestamp_us = 0;
  int data_size = 0;
  cv::Rect crop;
  cv::Mat image;  ///< empty if the frame has fewer bytes than its size
};

/// A stream of a device, whose frames are read one by one.
class SeenStream {
 public:
  SeenStream(openni::Device& device, openni::SensorType sensor) {
    EXPECT_EQ(stream_.create(device, sensor), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
  }
  ~SeenStream() {
    stream_.stop();
    stream_.destroy();
  }

  openni::VideoStream* operator->() { return &stream_; }

  /// False if nothing comes in time.
  bool read(SeenFrame& seen, std::chrono::milliseconds timeout = kGenerous) {
    openni::VideoStream* streams[] = {&stream_};
    int ready = 0;
    if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, static_cast<int>(timeout.count())) !=
        openni::STATUS_OK)
      return false;
    openni::VideoFrameRef frame;
    if (stream_.readFrame(&frame) != openni::STATUS_OK) return false;
    seen.index = frame.getFrameIndex();
    seen.timestamp_us = frame.getTimestamp();
    seen.data_size = frame.getDataSize();
    seen.crop = {frame.getCropOriginX(), frame.getCropOriginY(), frame.getWidth(), frame.getHeight()};
    const bool rgb = frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_RGB888;
    seen.image.release();
    if (frame.getDataSize() < frame.getStrideInBytes() * frame.getHeight()) return true;
    const cv::Mat shared(frame.getHeight(), frame.getWidth(), rgb ? CV_8UC3 : CV_16UC1,
                         const_cast<void*>(frame.getData()),
                         static_cast<std::size_t>(frame.getStrideInBytes()));
    shared.copyTo(seen.image);
    return true;
  }

 private:
  openni::VideoStream stream_;
};

/// Counts OpenNI2's reports about devices.
class DeviceEvents : public openni::OpenNI::DeviceConnectedListener,
                     public openni::OpenNI::DeviceDisconnectedListener,
                     public openni::OpenNI::DeviceStateChangedListener {
 public:
  DeviceEvents() {
    openni::OpenNI::addDeviceConnectedListener(this);
    openni::OpenNI::addDeviceDisconnectedListener(this);
    openni::OpenNI::addDeviceStateChangedListener(this);
  }
  ~DeviceEvents() override {
    openni::OpenNI::removeDeviceConnectedListener(this);
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    openni::OpenNI::removeDeviceStateChangedListener(this);
  }
  DeviceEvents(const DeviceEvents&) = delete;
  DeviceEvents& operator=(const DeviceEvents&) = delete;

  void onDeviceConnected(const openni::DeviceInfo*) override { note("connected"); }
  void onDeviceDisconnected(const openni::DeviceInfo*) override { note("disconnected"); }
  void onDeviceStateChanged(const openni::DeviceInfo*, openni::DeviceState state) override {
    note(state == openni::DEVICE_STATE_OK ? "ok" : "error");
  }

  /// Waits until `what` was reported `times`.
  bool wait_for(const std::string& what, int times = 1) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kGenerous, [&] { return counts_[what] >= times; });
  }
  int count(const std::string& what) {
    const std::lock_guard lock(mutex_);
    return counts_[what];
  }

 private:
  void note(const std::string& what) {
    {
      const std::lock_guard lock(mutex_);
      ++counts_[what];
    }
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, int> counts_;
};

}  // namespace saccade
