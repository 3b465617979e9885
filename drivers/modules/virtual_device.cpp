#include "drivers/modules/virtual_device.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kNominalRate = 30;
// OpenNI2's codecs drop depths that are not below this.
constexpr int kAboveEveryDepth = 65535;
constexpr std::chrono::milliseconds kNoWait{0};
constexpr std::chrono::milliseconds kLate{50};

// The first frame that can be used.
Frame first_frame(FrameSource& source) {
  Frame frame;
  std::string reason = "it is empty";
  while (true) {
    const ReadResult read = source.read(frame, kNoWait);
    if (read.status == ReadStatus::frame) return frame;
    if (read.status != ReadStatus::rejected)
      throw unreadable("no frame that can be used", source.info().uri, reason);
    reason = read.reason;
  }
}

std::vector<StreamKind> kinds_of(FrameSource& source) {
  source.seek(0);
  const Frame frame = first_frame(source);
  source.seek(0);
  std::vector<cv::Size> sizes = {frame.size()};
  if (frame.size().width % 2 == 0 && frame.size().height % 2 == 0) sizes.push_back(frame.size() / 2);
  const std::vector<int> rates = {kNominalRate, 2 * kNominalRate};
  std::vector<StreamKind> kinds = {
      {ONI_SENSOR_DEPTH, video_modes(ONI_PIXEL_FORMAT_DEPTH_1_MM, sizes, rates), kAboveEveryDepth}};
  if (!frame.colour.empty())
    kinds.push_back({ONI_SENSOR_COLOR, video_modes(ONI_PIXEL_FORMAT_RGB888, sizes, rates), 0});
  return kinds;
}

std::unique_ptr<FrameSource> from_frame(std::unique_ptr<FrameSource> source, std::int64_t first) {
  source->seek(first);
  return source;
}

FieldOfView field_of_view(const SourceInfo& info) {
  const Intrinsics& camera = info.intrinsics;
  return {2 * std::atan(info.size.width / 2.0 / camera.fx),
          2 * std::atan(info.size.height / 2.0 / camera.fy)};
}

// Whole millimetres.
void round_depth(const cv::Mat1f& depth_mm, cv::Mat1w& rounded) {
  rounded.create(depth_mm.size());
  std::transform(depth_mm.begin(), depth_mm.end(), rounded.begin(), [](float mm) {
    return mm < static_cast<float>(kAboveEveryDepth) - 0.5F ? static_cast<std::uint16_t>(std::lround(mm))
                                                            : std::uint16_t{0};
  });
}

template <typename Image>
void keep_even(const Image& image, Image& half) {
  half.create(image.size() / 2);
  for (int row = 0; row < half.rows; ++row)
    for (int column = 0; column < half.cols; ++column) half(row, column) = image(2 * row, 2 * column);
}

// A stream that has the settings of a camera, or pretends to.
class VirtualStream : public ModuleStream {
 public:
  VirtualStream(const StreamKind& kind, FieldOfView view, bool ignores_settings,
                std::function<bool(bool)> running)
      : ModuleStream(
            kind, [view] { return view; }, std::move(running)) {
    if (ignores_settings)
      properties_.add<OniBool>(
          ONI_STREAM_PROPERTY_MIRRORING, [] { return FALSE; }, accept);
    if (kind.sensor != ONI_SENSOR_COLOR) return;
    add_setting(ONI_STREAM_PROPERTY_AUTO_EXPOSURE, TRUE, 0, 1, ignores_settings);
    add_setting(ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE, TRUE, 0, 1, ignores_settings);
    add_setting(ONI_STREAM_PROPERTY_EXPOSURE, 33, 1, 1000, ignores_settings);
    add_setting(ONI_STREAM_PROPERTY_GAIN, 100, 0, 1000, ignores_settings);
  }

 private:
  static OniStatus accept(const int&) { return ONI_STATUS_OK; }

  void add_setting(int id, int initial, int low, int high, bool ignored) {
    const auto value = std::make_shared<std::atomic<int>>(initial);
    const std::function<int()> get = [value] { return value->load(); };
    if (ignored) return properties_.add<int>(id, get, accept);
    properties_.add<int>(id, get, [=](const int& wanted) {
      if (wanted < low || wanted > high) return ONI_STATUS_BAD_PARAMETER;
      *value = wanted;
      return ONI_STATUS_OK;
    });
  }
};

}  // namespace

std::unique_ptr<FrameSource> open_playable(const VirtualSpec& spec) {
  const std::string hint = "a recording, a folder or a synthetic scene is expected";
  if (spec.source.starts_with("openni2"))  // it would open itself
    throw usage_error("a live sensor cannot be a virtual device", spec.source, hint);
  auto source = open_source(spec.source);
  if (source->info().live) throw usage_error("a live source cannot be a virtual device", spec.source, hint);
  kinds_of(*source);
  return source;
}

VirtualDevice::VirtualDevice(const VirtualSpec& spec, std::unique_ptr<FrameSource> source,
                             std::int64_t first_frame, Plug plug)
    : ModuleDevice({"VIRTUAL-1", "none"}, kinds_of(*source)),
      spec_(spec),
      view_(field_of_view(source->info())),
      plug_(std::move(plug)),
      source_(from_frame(std::move(source), first_frame)),
      player_([this](const std::stop_token& stop) { play(stop); }) {
  if (spec_.ignores_settings)
    properties_.add<OniImageRegistrationMode>(
        ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION, [] { return ONI_IMAGE_REGISTRATION_OFF; },
        [](const OniImageRegistrationMode&) { return ONI_STATUS_OK; });
}

VirtualDevice::~VirtualDevice() {
  player_.request_stop();
  player_.join();
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType sensor) {
  const StreamKind* kind = kind_of(sensor);
  if (kind == nullptr) return nullptr;
  auto stream = std::make_shared<VirtualStream>(*kind, view_, spec_.ignores_settings,
                                                [this](bool start) { return change_running(start); });
  const std::lock_guard lock(mutex_);
  streams_.push_back(stream);
  return stream.get();
}

void VirtualDevice::destroyStream(oni::driver::StreamBase* stream) {
  stream->stop();
  const std::lock_guard lock(mutex_);
  std::erase_if(streams_, [&](const auto& s) { return s.get() == stream; });
}

bool VirtualDevice::change_running(bool start) {
  {
    const std::lock_guard lock(mutex_);
    running_ += start ? 1 : -1;
  }
  wake_.notify_one();
  return true;
}

void VirtualDevice::play(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  due_ = Clock::now();
  while (wake_.wait(lock, stop, [this] { return running_ > 0; })) {
    if (Clock::now() - due_ > kLate) due_ = Clock::now();  // after a pause, or where the source is too slow
    wake_.wait_until(lock, stop, due_, [] { return false; });
    if (stop.stop_requested()) return;
    playing_ = streams_;
    lock.unlock();
    try {
      due_ += give_next();
    } catch (const std::exception& error) {
      plug_.fail(error.what());
      return;
    }
    lock.lock();
    playing_.clear();
  }
}

// Gives one frame to the streams that are started; the time until the next.
std::chrono::nanoseconds VirtualDevice::give_next() {
  int fastest = 0;
  for (const auto& stream : playing_)
    if (stream->started()) fastest = std::max(fastest, stream->settings().mode.fps);
  const double rate_hz = spec_.rate_hz.value_or(fastest > 0 ? fastest : kNominalRate);
  auto pause = std::chrono::nanoseconds(std::llround(1e9 / rate_hz));
  if (fastest == 0 || !plug_.present()) return pause;
  const std::int64_t number = given_++;
  if (read_next()) {
    const auto time = std::chrono::duration_cast<std::chrono::microseconds>(due_ - opened_);
    for (const auto& stream : playing_) {
      const int fps = stream->started() ? stream->settings().mode.fps : fastest;
      if (number % std::max(1, fastest / fps) == 0)
        give(*stream, number, static_cast<std::uint64_t>(time.count()));
    }
  }
  plug_.count();
  if (given_ % spec_.stall_after == 0) pause += spec_.stall;
  return pause;
}

// Reads a frame, the first again after the last; false if it is rejected.
bool VirtualDevice::read_next() {
  ReadResult read = source_->read(frame_, kNoWait);
  if (read.status == ReadStatus::end) {
    source_->seek(0);
    read = source_->read(frame_, kNoWait);
  }
  if (read.status != ReadStatus::frame) return false;
  round_depth(frame_.depth_mm, depth_);
  if (!frame_.colour.empty()) cv::cvtColor(frame_.colour, colour_, cv::COLOR_BGR2RGB);
  return true;
}

void VirtualDevice::give(ModuleStream& stream, std::int64_t number, std::uint64_t timestamp_us) {
  const bool is_depth = stream.kind().sensor == ONI_SENSOR_DEPTH;
  if (!is_depth && frame_.colour.empty()) return;
  const bool whole = stream.settings().mode.resolutionX == frame_.size().width;
  cv::Mat image;
  if (is_depth) {
    if (!whole) keep_even(depth_, half_depth_);
    image = whole ? depth_ : half_depth_;
  } else {
    if (!whole) keep_even(colour_, half_colour_);
    image = whole ? colour_ : half_colour_;
  }
  const bool cut = is_depth && spec_.short_frame > 0 && (number + 1) % spec_.short_frame == 0;
  const auto bytes = static_cast<int>(image.total() * image.elemSize());
  stream.deliver(image, static_cast<int>(number + 1), timestamp_us, cut ? bytes / 2 : 0);
}

}  // namespace saccade
