#include "drivers/openni2/openni2_source.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "drivers/openni2/openni2_thread.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPoll{20};  // how soon an interrupt or a loss is noticed
constexpr std::string_view kScheme = "openni2";

std::string device_uri(const std::string& uri) {
  return uri.size() > kScheme.size() ? uri.substr(kScheme.size() + 1) : "";
}

milliseconds time_left(std::chrono::steady_clock::time_point deadline) {
  return std::chrono::ceil<milliseconds>(deadline - std::chrono::steady_clock::now());
}

}  // namespace

OpenNi2Source::OpenNi2Source(const std::string& uri, const SensorSettings& settings)
    : connection_(device_uri(uri), settings) {
  const SensorMode mode = settings.mode.value_or(SensorMode{});
  info_.uri = uri;
  info_.kind = kScheme;
  info_.live = info_.sequence = true;
  info_.size = {mode.width, mode.height};
  info_.rate_hz = mode.rate_hz;
  info_.intrinsics = Intrinsics::guess_for(info_.size);
  const OpenNi2Device* device = connection_.device();
  if (device == nullptr) return;
  info_.size = device->size();
  info_.rate_hz = device->rate_hz();
  info_.intrinsics = device->intrinsics();
  info_.notes = device->notes();
  restart_streams();
}

void OpenNi2Source::seek(std::int64_t) { throw std::logic_error("OpenNi2Source: a live source cannot seek"); }

void OpenNi2Source::interrupt() noexcept {
  const std::lock_guard lock(mutex_);
  interrupted_ = true;
  wake_.notify_all();
}

bool OpenNi2Source::take_interrupt() {
  const std::lock_guard lock(mutex_);
  return std::exchange(interrupted_, false);
}

ReadResult OpenNi2Source::read(Frame& frame, milliseconds timeout) {
  const Clock::time_point deadline = Clock::now() + timeout;
  do {
    if (take_interrupt()) break;
    if (connection_.device() != nullptr) {
      if (std::optional<ReadResult> result = poll_device(frame, deadline)) return *std::move(result);
      continue;
    }
    wait_for_device(deadline);
    if (!connection_.try_to_connect()) continue;
    check_size();
    restart_streams();
  } while (Clock::now() < deadline);
  return {ReadStatus::timeout, ""};
}

void OpenNi2Source::wait_for_device(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  wake_.wait_until(lock, std::min({deadline, connection_.next_try(), Clock::now() + kPoll}),
                   [this] { return interrupted_; });
}

// The size in info() holds for every frame.
void OpenNi2Source::check_size() const {
  const cv::Size size = connection_.device()->size();
  if (size == info_.size) return;
  throw failed(
      fmt::format("the device gives {}x{}, not {}x{}", size.width, size.height, info_.size.width,
                  info_.size.height),
      connection_.name(),
      fmt::format("start again now that it is there, or with --mode {}x{}", size.width, size.height));
}

void OpenNi2Source::restart_streams() {
  const OpenNi2Device& device = *connection_.device();
  pairing_.restart(1'000'000 / std::max(1, device.rate_hz()), device.has_colour());
  clock_.restart();
}

std::optional<ReadResult> OpenNi2Source::poll_device(Frame& frame, Clock::time_point deadline) {
  if (bad_frame_) return reject(frame);
  connection_.apply_requests();
  if (const auto why = connection_.reason_of_loss()) {
    if (pairing_.has_depth()) return deliver(frame);
    connection_.lose(*why);
    return ReadResult{ReadStatus::timeout, ""};  // at once, so that a short loss is seen, too
  }
  const milliseconds slice = std::clamp(time_left(deadline), milliseconds(0), kPoll);
  auto ready = OpenNi2Device::Ready::nothing;
  on_openni2_thread([&] { ready = connection_.device()->wait(slice); });
  switch (ready) {
    case OpenNi2Device::Ready::depth:
      if (auto result = take_depth(frame)) return result;
      break;
    case OpenNi2Device::Ready::colour:
      take_colour();
      break;
    case OpenNi2Device::Ready::nothing:
      break;
  }
  if (pairing_.is_ripe()) return deliver(frame);
  if (bad_frame_) return reject(frame);
  return std::nullopt;
}

// A good frame waits for its colour. It drives out the one that waits, which comes first; so does a bad one.
std::optional<ReadResult> OpenNi2Source::take_depth(Frame& frame) {
  std::int64_t time_us = 0;
  Outcome outcome = Outcome::success();
  on_openni2_thread([&] { outcome = connection_.device()->read_depth(depth_, time_us); });
  connection_.note_depth();
  std::optional<ReadResult> before;
  if (pairing_.has_depth()) before = deliver(frame);
  if (outcome)
    pairing_.put_depth(depth_, time_us);
  else
    bad_frame_ = BadFrame{time_us, outcome.reason()};
  return before;
}

void OpenNi2Source::take_colour() {
  std::int64_t time_us = 0;
  bool usable = false;
  on_openni2_thread([&] { usable = static_cast<bool>(connection_.device()->read_colour(colour_, time_us)); });
  if (usable) pairing_.put_colour(colour_, time_us);
}

ReadResult OpenNi2Source::reject(Frame& frame) {
  const BadFrame bad = *std::exchange(bad_frame_, std::nullopt);
  frame.index = next_index_++;
  frame.timestamp_us = clock_.time_us(bad.time_us, Clock::now());
  return {ReadStatus::rejected, bad.reason};
}

ReadResult OpenNi2Source::deliver(Frame& frame) {
  const FramePairing::Taken taken = pairing_.take(frame.depth_mm, frame.colour);
  frame.index = next_index_++;
  frame.timestamp_us = clock_.time_us(taken.time_us, Clock::now());
  frame.name.clear();
  frame.intrinsics = connection_.device()->intrinsics();
  frame.truth = {};
  if (taken.colour_missed) connection_.note_colourless();
  return {ReadStatus::frame, ""};
}

}  // namespace saccade
