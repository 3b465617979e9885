#include "sources/depth_video.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "core/error.hpp"
#include "core/png.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExactRoutes =
    "depth must be FFV1 gray16le in Matroska, 16-bit PNGs in Matroska, or rawvideo gray16le in .nut";

constexpr int code(char a, char b, char c, char d) { return a | b << 8 | c << 16 | d << 24; }
constexpr int kGrey16Little = code('Y', '1', 0, 16), kGrey16Big = code(16, 0, '1', 'Y');
constexpr int kFfv1 = code('F', 'F', 'V', '1');

// A file's packets, not decoded.
cv::VideoCapture open_packets(const fs::path& path) {
  return cv::VideoCapture(path.string(), cv::CAP_FFMPEG, {cv::CAP_PROP_FORMAT, -1});
}

std::span<const std::uint8_t> bytes_of(const cv::Mat& packet) {
  return {packet.data, packet.total() * packet.elemSize()};
}

bool is_png(std::span<const std::uint8_t> packet) {
  constexpr std::array<std::uint8_t, 4> kSignature = {0x89, 'P', 'N', 'G'};
  return packet.size() > 8 && std::equal(kSignature.begin(), kSignature.end(), packet.begin());
}

int as_code(double property) { return static_cast<int>(static_cast<std::uint32_t>(property)); }

int upper_case(int fourcc) {
  for (int shift = 0; shift < 32; shift += 8)
    if (const int letter = fourcc >> shift & 0xff; letter >= 'a' && letter <= 'z') fourcc -= 0x20 << shift;
  return fourcc;
}

// Depth from an OpenCV capture, in a form that derived classes decode.
class CaptureVideo : public DepthVideo {
 public:
  bool read(cv::Mat1w& depth, std::int64_t& time_us) final {
    if (!capture_.read(buffer_) || buffer_.empty()) return false;
    time_us = time_of(count_++);
    decode(depth);
    if (depth.size() != size_)
      throw std::runtime_error(
          fmt::format("{}x{} instead of {}x{}", depth.cols, depth.rows, size_.width, size_.height));
    return true;
  }
  bool skip() final { return capture_.grab() && ++count_ > 0; }

 protected:
  CaptureVideo(cv::VideoCapture capture, cv::Size size) : capture_(std::move(capture)) {
    size_ = size;
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    if (std::isfinite(rate) && rate > 0) rate_hz_ = rate;
  }
  // Fills `depth` from buffer_, or throws std::runtime_error.
  virtual void decode(cv::Mat1w& depth) = 0;
  virtual std::int64_t time_of(std::int64_t index) {
    return std::llround(static_cast<double>(index) * 1e6 / rate_hz_);
  }

  cv::VideoCapture capture_;
  cv::Mat buffer_;

 private:
  std::int64_t count_ = 0;
};

class PngPackets final : public CaptureVideo {
 public:
  PngPackets(cv::VideoCapture capture, cv::Size size) : CaptureVideo(std::move(capture), size) {}

 private:
  void decode(cv::Mat1w& depth) override {
    const cv::Mat image = decode_png(bytes_of(buffer_));
    if (image.type() != CV_16UC1) throw std::runtime_error("not a 16-bit grey PNG");
    image.copyTo(depth);
  }
};

class RawPackets final : public CaptureVideo {
 public:
  RawPackets(cv::VideoCapture capture, cv::Size size) : CaptureVideo(std::move(capture), size) {}

 private:
  void decode(cv::Mat1w& depth) override {
    const auto bytes = bytes_of(buffer_);
    if (bytes.size() != 2 * static_cast<std::size_t>(size_.area()))
      throw std::runtime_error(
          fmt::format("{} bytes for {}x{} pixels", bytes.size(), size_.width, size_.height));
    depth.create(size_);
    std::copy(bytes.begin(), bytes.end(), depth.data);
  }
};

class DecodedFrames final : public CaptureVideo {
 public:
  // `clock` reads the same frames, for their times: those of a GStreamer pipeline run ahead.
  DecodedFrames(cv::VideoCapture capture, cv::Size size, cv::VideoCapture clock = {})
      : CaptureVideo(std::move(capture), size), clock_(std::move(clock)) {}

 private:
  void decode(cv::Mat1w& depth) override {
    if (buffer_.type() != CV_16UC1) throw std::runtime_error("not 16-bit grey");
    buffer_.copyTo(depth);
  }
  std::int64_t time_of(std::int64_t index) override {
    while (clocked_ <= index && clock_.grab()) ++clocked_;
    return clocked_ > index ? std::llround(1000 * clock_.get(cv::CAP_PROP_POS_MSEC))
                            : CaptureVideo::time_of(index);
  }

  cv::VideoCapture clock_;
  std::int64_t clocked_ = 0;  // frames read from clock_
};

std::unique_ptr<DepthVideo> open_ffv1(const fs::path& path, cv::Size size) {
  std::string quoted;
  for (const char c : path.string()) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  cv::VideoCapture capture(fmt::format("filesrc location=\"{}\" ! matroskademux ! avdec_ffv1 ! "
                                       "video/x-raw,format=GRAY16_LE ! appsink sync=false",
                                       quoted),
                           cv::CAP_GSTREAMER);
  if (!capture.isOpened())
    throw unreadable(
        "this FFV1 video cannot be read as 16-bit grey", path.string(),
        "GStreamer does it with the packages gstreamer1.0-plugins-good and gstreamer1.0-libav, from "
        "Matroska");
  return std::make_unique<DecodedFrames>(std::move(capture), size,
                                         cv::VideoCapture(path.string(), cv::CAP_FFMPEG));
}

}  // namespace

void quieten_video_libraries() {
  static std::once_flag once;
  std::call_once(once, [] {
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  });
}

std::unique_ptr<DepthVideo> open_depth_video(const fs::path& path) {
  quieten_video_libraries();
  cv::VideoCapture packets = open_packets(path);
  cv::Mat first;
  if (!packets.isOpened() || !packets.read(first))
    throw unreadable("no video that can be read", path.string(), "the file may be truncated or not a video");
  const cv::Size size(static_cast<int>(packets.get(cv::CAP_PROP_FRAME_WIDTH)),
                      static_cast<int>(packets.get(cv::CAP_PROP_FRAME_HEIGHT)));
  const int codec = upper_case(as_code(packets.get(cv::CAP_PROP_FOURCC)));
  const int pixels = as_code(packets.get(cv::CAP_PROP_CODEC_PIXEL_FORMAT));
  if (size.width > kLargestSide || size.height > kLargestSide)
    throw unreadable(fmt::format("images of {}x{} are too large", size.width, size.height), path.string(),
                     fmt::format("at most {} pixels a side", kLargestSide));
  if (is_png(bytes_of(first))) {
    if (pixels == kGrey16Big || pixels == kGrey16Little)
      return std::make_unique<PngPackets>(open_packets(path), size);
  } else if (codec == kGrey16Little) {
    return std::make_unique<RawPackets>(open_packets(path), size);
  } else if (codec == kFfv1 && pixels == kGrey16Little) {
    return open_ffv1(path, size);
  } else if (pixels == kGrey16Little || pixels == kGrey16Big) {
    throw unreadable("16-bit grey in a codec that would be flattened to 8 bits", path.string(), kExactRoutes);
  }
  if (path.stem().string().ends_with("_depth"))
    throw unreadable("this depth video has 8 bits a pixel, or would be flattened to 8", path.string(),
                     kExactRoutes);
  return nullptr;
}

std::unique_ptr<DepthVideo> open_depth_images(const std::string& pattern) {
  quieten_video_libraries();
  cv::VideoCapture capture(pattern, cv::CAP_IMAGES);
  cv::Mat first;
  if (!capture.isOpened() || !capture.read(first) || first.empty())
    throw unreadable("no images of that pattern", pattern,
                     "e.g. depth_%04d.png for depth_0000.png, depth_0001.png, ..");
  if (first.type() != CV_16UC1)
    throw unreadable("the images are not 16-bit grey depth", pattern, "16-bit grey PNGs in mm are expected");
  return std::make_unique<DecodedFrames>(cv::VideoCapture(pattern, cv::CAP_IMAGES), first.size());
}

}  // namespace saccade
