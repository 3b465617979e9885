#include "sources/video_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/error.hpp"
#include "sources/colour_video.hpp"
#include "sources/depth_video.hpp"
#include "sources/folder_listing.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::array kVideoEndings = {".mkv", ".nut",  ".mov", ".mp4",  ".m4v",
                                      ".avi", ".webm", ".mpg", ".mpeg", ".ogv"};
constexpr const char* kNoDepth =
    "there is no depth in it: only the models of the image work, and no lengths are known";
constexpr double kDefaultRateHz = 30;

void set_camera(SourceInfo& info, const fs::path& folder) {
  info.intrinsics = read_meta(folder).value_or(Intrinsics::guess_for(info.size));
}

// Fields that are the same for every frame of these sources, and the depth of one that has none.
void begin_frame(Frame& frame, const SourceInfo& info, std::int64_t index) {
  frame.index = index;
  frame.name.clear();
  frame.intrinsics = info.intrinsics;
  frame.truth = {};
}

void set_no_depth(Frame& frame, cv::Size size) {
  frame.depth_mm.create(size);
  frame.depth_mm.setTo(0);
}

// Depth, with colour where there is some.
class DepthVideoSource final : public FrameSource {
 public:
  using OpenDepth = std::function<std::unique_ptr<DepthVideo>()>;

  DepthVideoSource(SourceInfo info, OpenDepth open, std::unique_ptr<ColourVideo> colour)
      : info_(std::move(info)), open_(std::move(open)), depth_(open_()), colour_(std::move(colour)) {
    info_.size = depth_->size();
    info_.rate_hz = depth_->rate_hz();
    tolerance_us_ = std::llround(0.75e6 / info_.rate_hz);
    if (!colour_) return;
    tolerance_us_ = std::max<std::int64_t>(tolerance_us_, std::llround(0.75e6 / colour_->rate_hz()));
    if (colour_->size() != info_.size)
      info_.notes.push_back(fmt::format("colour of {} x {} is scaled to the depth's {} x {}",
                                        colour_->size().width, colour_->size().height, info_.size.width,
                                        info_.size.height));
  }

  const SourceInfo& info() const override { return info_; }

  void seek(std::int64_t index) override { wanted_ = std::max<std::int64_t>(index, 0); }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (!go_to_wanted()) return {ReadStatus::end, ""};
    begin_frame(frame, info_, wanted_);
    try {
      ++wanted_;
      ++next_;
      if (!depth_->read(image_, frame.timestamp_us)) return {ReadStatus::end, ""};
      image_.convertTo(frame.depth_mm, CV_32F);
    } catch (const std::runtime_error& error) {
      return {ReadStatus::rejected, fmt::format("frame {}: {}", frame.index, error.what())};
    }
    if (!colour_ || !colour_->nearest(frame.timestamp_us, tolerance_us_, colour_image_)) {
      frame.colour.release();
      return {ReadStatus::frame, colour_ ? "no colour of that time" : ""};
    }
    if (colour_image_.size() == info_.size)
      colour_image_.copyTo(frame.colour);
    else
      cv::resize(colour_image_, frame.colour, info_.size, 0, 0, cv::INTER_AREA);
    return {ReadStatus::frame, ""};
  }

 private:
  bool go_to_wanted() {
    if (wanted_ < next_) {
      depth_ = open_();
      next_ = 0;
    }
    for (; next_ < wanted_; ++next_)
      if (!depth_->skip()) return false;
    return true;
  }

  SourceInfo info_;
  OpenDepth open_;
  std::unique_ptr<DepthVideo> depth_;
  std::unique_ptr<ColourVideo> colour_;  // nullptr = none
  std::int64_t tolerance_us_ = 0, wanted_ = 0, next_ = 0;
  cv::Mat1w image_;
  cv::Mat3b colour_image_;
};

// Colour without depth.
class ColourVideoSource final : public FrameSource {
 public:
  explicit ColourVideoSource(const fs::path& path) : path_(path), video_(open()) {
    info_.uri = path.string();
    info_.kind = "video";
    info_.size = video_->size();
    info_.rate_hz = video_->rate_hz();
    info_.has_depth = false;
    info_.notes.emplace_back(kNoDepth);
    set_camera(info_, path.parent_path());
  }

  const SourceInfo& info() const override { return info_; }
  void seek(std::int64_t index) override { wanted_ = std::max<std::int64_t>(index, 0); }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (wanted_ < next_) {
      video_ = open();
      next_ = 0;
    }
    for (; next_ < wanted_; ++next_)
      if (!video_->skip()) return {ReadStatus::end, ""};
    begin_frame(frame, info_, wanted_);
    if (!video_->read(frame.colour, frame.timestamp_us)) return {ReadStatus::end, ""};
    ++wanted_;
    ++next_;
    if (frame.colour.size() != info_.size) return {ReadStatus::rejected, "another size than the first image"};
    set_no_depth(frame, info_.size);
    return {ReadStatus::frame, ""};
  }

 private:
  std::unique_ptr<ColourVideo> open() const {
    return std::make_unique<ColourVideo>(path_.string(), cv::CAP_FFMPEG, kDefaultRateHz);
  }

  fs::path path_;
  std::unique_ptr<ColourVideo> video_;
  SourceInfo info_;
  std::int64_t wanted_ = 0, next_ = 0;
};

// A camera of the system.
class WebcamSource final : public FrameSource {
 public:
  explicit WebcamSource(const std::string& uri) {
    quieten_video_libraries();
    const std::string device = uri.substr(uri.find(':') + 1);
    capture_.emplace_back(device, cv::CAP_V4L2);
    cv::Mat first;
    if (!capture_[0].isOpened() || !capture_[0].read(first) || first.type() != CV_8UC3)
      throw unreadable("no camera that gives pictures", uri,
                       "e.g. v4l2:/dev/video0; may this user read it, and does no other program use it?");
    info_.uri = uri;
    info_.kind = "v4l2";
    info_.size = first.size();
    info_.rate_hz = std::max(0.0, capture_[0].get(cv::CAP_PROP_FPS));
    info_.live = true;
    info_.has_depth = false;
    info_.notes.emplace_back(kNoDepth);
    info_.intrinsics = Intrinsics::guess_for(info_.size);
  }

  const SourceInfo& info() const override { return info_; }
  void seek(std::int64_t) override { throw std::logic_error("WebcamSource: a live source cannot seek"); }

  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override {
    std::vector<int> ready;
    const auto wait = std::chrono::duration_cast<std::chrono::nanoseconds>(timeout);
    if (!cv::VideoCapture::waitAny(capture_, ready, wait.count())) return {ReadStatus::timeout, ""};
    begin_frame(frame, info_, count_);
    if (!capture_[0].retrieve(frame.colour) || frame.colour.empty())
      throw failed("the camera is lost", info_.uri, "is it still plugged in?");
    ++count_;
    const auto since = std::chrono::steady_clock::now() - opened_;
    frame.timestamp_us = std::chrono::duration_cast<std::chrono::microseconds>(since).count();
    if (frame.colour.size() != info_.size) return {ReadStatus::rejected, "another size than the first image"};
    set_no_depth(frame, info_.size);
    return {ReadStatus::frame, ""};
  }

 private:
  std::vector<cv::VideoCapture> capture_;  // one, in the form that waitAny() takes
  SourceInfo info_;
  std::int64_t count_ = 0;
  const std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
};

// NAME_rgb.* beside NAME_depth.*.
std::unique_ptr<ColourVideo> colour_beside(const fs::path& path, double rate_hz) {
  constexpr std::string_view kDepth = "_depth";
  std::string stem = path.stem().string();
  if (!stem.ends_with(kDepth)) return nullptr;
  stem.resize(stem.size() - kDepth.size());
  for (const char* ending : kVideoEndings)
    if (const fs::path colour = path.parent_path() / (stem + "_rgb" + ending); fs::exists(colour))
      return std::make_unique<ColourVideo>(colour.string(), cv::CAP_FFMPEG, rate_hz);
  return nullptr;
}

// The pattern with "rgb" for the last "depth" of the file's name, as .png or .jpg, if there are such images.
std::unique_ptr<ColourVideo> colour_beside(const std::string& pattern, double rate_hz) {
  const fs::path path(pattern);
  std::string name = path.stem().string();
  constexpr std::string_view kDepth = "depth";
  const auto found = name.rfind(kDepth);
  if (found == std::string::npos) return nullptr;
  name.replace(found, kDepth.size(), "rgb");
  for (const char* ending : {".png", ".jpg"}) {
    const std::string colour = (path.parent_path() / (name + ending)).string();
    if (cv::VideoCapture(colour, cv::CAP_IMAGES).isOpened())
      return std::make_unique<ColourVideo>(colour, cv::CAP_IMAGES, rate_hz);
  }
  return nullptr;
}

}  // namespace

bool is_video_name(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kVideoEndings.begin(), kVideoEndings.end(), ending) != kVideoEndings.end();
}

bool is_image_pattern(const std::string& text) {
  static const std::regex pattern("[^%]*%0?[0-9]*d[^%/]*\\.png");
  return std::regex_match(text, pattern);
}

std::unique_ptr<FrameSource> open_video(const fs::path& path) {
  const auto depth = open_depth_video(path);
  if (!depth) return std::make_unique<ColourVideoSource>(path);
  SourceInfo info;
  info.uri = path.string();
  info.kind = "video";
  info.size = depth->size();
  set_camera(info, path.parent_path());
  return std::make_unique<DepthVideoSource>(
      std::move(info), [path] { return open_depth_video(path); }, colour_beside(path, depth->rate_hz()));
}

std::unique_ptr<FrameSource> open_image_sequence(const std::string& pattern) {
  const auto depth = open_depth_images(pattern);
  SourceInfo info;
  info.uri = pattern;
  info.kind = "images";
  info.size = depth->size();
  set_camera(info, fs::path(pattern).parent_path());
  return std::make_unique<DepthVideoSource>(
      std::move(info), [pattern] { return open_depth_images(pattern); },
      colour_beside(pattern, depth->rate_hz()));
}

std::unique_ptr<FrameSource> open_webcam(const std::string& uri) {
  return std::make_unique<WebcamSource>(uri);
}

}  // namespace saccade
