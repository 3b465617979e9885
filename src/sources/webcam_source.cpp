#include <chrono>
#include <stdexcept>
#include <string>

#include "core/error.hpp"
#include "sources/frame_fields.hpp"
#include "sources/source_kind.hpp"
#include "sources/v4l2_camera.hpp"

namespace saccade {
namespace {

constexpr std::string_view kV4l2Scheme = "v4l2:";

// A camera of the system: colour without depth.
class WebcamSource final : public FrameSource {
 public:
  explicit WebcamSource(const std::string& uri) try : camera_(uri.substr(kV4l2Scheme.size())) {
    constexpr std::chrono::seconds kFirstPicture{10};  // some cameras take seconds to start
    cv::Mat3b first;
    if (camera_.read(first, kFirstPicture) == V4l2Camera::Read::timeout)
      throw std::runtime_error("none came in 10 s");
    info_.uri = uri;
    info_.kind = "v4l2";
    info_.size = camera_.size();
    info_.rate_hz = camera_.rate_hz();
    info_.live = info_.sequence = true;
    info_.has_depth = false;
    info_.notes.emplace_back(kNoDepthNote);
    info_.intrinsics = Intrinsics::guess_for(info_.size);
  } catch (const std::runtime_error& error) {
    throw unreadable(std::string("no camera that gives pictures: ") + error.what(), uri,
                     "e.g. v4l2:/dev/video0; may this user read it, and does no other program use it?");
  }

  const SourceInfo& info() const override { return info_; }
  void seek(std::int64_t) override { throw std::logic_error("WebcamSource: a live source cannot seek"); }

  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override {
    const V4l2Camera::Read read = read_picture(frame.colour, timeout);
    if (read == V4l2Camera::Read::timeout) return {ReadStatus::timeout, ""};
    begin_frame(frame, info_, count_++);
    const auto since = std::chrono::steady_clock::now() - opened_;
    frame.timestamp_us = std::chrono::duration_cast<std::chrono::microseconds>(since).count();
    if (read == V4l2Camera::Read::damaged) return {ReadStatus::rejected, "damaged image"};
    set_no_depth(frame, info_.size);
    return {ReadStatus::frame, ""};
  }

 private:
  V4l2Camera::Read read_picture(cv::Mat3b& picture, std::chrono::milliseconds timeout) try {
    return camera_.read(picture, timeout);
  } catch (const std::runtime_error& error) {
    throw failed(std::string("the camera is lost: ") + error.what(), info_.uri, "is it still plugged in?");
  }

  V4l2Camera camera_;
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
    .recognises = [](const SourceInput& input) { return input.uri.starts_with(kV4l2Scheme); },
    .open = [](const SourceInput& input, const SourceOptions&) -> std::unique_ptr<FrameSource> {
      return std::make_unique<WebcamSource>(input.uri);
    },
    .is_path = false,
    .is_device = true,
};

}  // namespace saccade
