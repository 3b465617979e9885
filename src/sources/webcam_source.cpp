#include <chrono>
#include <stdexcept>
#include <vector>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "core/error.hpp"
#include "sources/frame_fields.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace {

constexpr std::string_view kScheme = "v4l2:";

// A camera of the system: colour without depth.
class WebcamSource final : public FrameSource {
 public:
  explicit WebcamSource(const std::string& uri) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const std::string device = uri.substr(kScheme.size());
    capture_.emplace_back(device, cv::CAP_V4L2);
    cv::Mat first;
    if (!capture_[0].isOpened() || !capture_[0].read(first) || first.type() != CV_8UC3)
      throw unreadable("no camera that gives pictures", uri,
                       "e.g. v4l2:/dev/video0; may this user read it, and does no other program use it?");
    info_.uri = uri;
    info_.kind = "v4l2";
    info_.size = first.size();
    info_.rate_hz = std::max(0.0, capture_[0].get(cv::CAP_PROP_FPS));
    info_.live = info_.sequence = true;
    info_.has_depth = false;
    info_.notes.emplace_back(kNoDepthNote);
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

}  // namespace

extern const SourceKind kWebcamKind = {
    .name = "v4l2",
    .written = "v4l2:DEVICE",
    .help = "a camera of the system, e.g. v4l2:/dev/video0, as colour without depth",
    .recognised_by = "v4l2:",
    .recognises = [](const SourceInput& input) { return input.uri.starts_with(kScheme); },
    .open = [](const SourceInput& input, const SourceOptions&) -> std::unique_ptr<FrameSource> {
      return std::make_unique<WebcamSource>(input.uri);
    },
    .is_path = false,
    .is_device = true,
};

}  // namespace saccade
