#include "drivers/openni2/openni2_source.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "drivers/openni2/openni2_thread.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;
using Connection = SourceState::Connection;

constexpr milliseconds kSilence{2000}, kSilenceAfterOpening{5000};
constexpr milliseconds kFirstBackOff{100}, kLongestBackOff{2000};
constexpr milliseconds kPoll{20};  // how soon an interrupt or a loss is noticed
constexpr const char* kScheme = "openni2";
constexpr const char* kHint = "plug in a sensor; saccade doctor looks for the reason";
constexpr const char* kHintOfLoss = "plug it in again; without --no-reconnect it is waited for";

std::string device_uri(const std::string& uri) {
  const std::string scheme = kScheme;
  return uri.size() > scheme.size() ? uri.substr(scheme.size() + 1) : "";
}

SensorValues wanted_values(const SensorSettings& settings) {
  SensorValues wanted;
  wanted.registration = settings.registration;
  wanted.mirror = settings.mirror;
  wanted.auto_exposure = !settings.exposure;
  wanted.exposure = settings.exposure;
  wanted.auto_white_balance = settings.auto_white_balance;
  return wanted;
}

// Lays what is not empty in `from` over `to`.
void lay_over(SensorValues& to, const SensorValues& from) {
  const auto lay = [](auto& a, const auto& b) {
    if (b) a = b;
  };
  lay(to.registration, from.registration);
  lay(to.mirror, from.mirror);
  lay(to.auto_exposure, from.auto_exposure);
  lay(to.exposure, from.exposure);
  lay(to.auto_white_balance, from.auto_white_balance);
}

std::string name_of(const DeviceIdentity& device) {
  return fmt::format("{} {} ({})", device.vendor, device.name, device.uri);
}

milliseconds time_left(std::chrono::steady_clock::time_point deadline) {
  return std::chrono::ceil<milliseconds>(deadline - std::chrono::steady_clock::now());
}

}  // namespace

OpenNi2Source::OpenNi2Source(const std::string& uri, const SensorSettings& settings)
    : settings_(settings),
      wanted_uri_(device_uri(uri)),
      runtime_(OpenNi2Runtime::instance()),
      back_off_(kFirstBackOff),
      wanted_(wanted_values(settings)) {
  const SensorMode mode = settings.mode.value_or(SensorMode{});
  info_.uri = uri;
  info_.kind = kScheme;
  info_.live = true;
  info_.size = {mode.width, mode.height};
  info_.rate_hz = mode.rate_hz;
  info_.intrinsics = Intrinsics::guess_for(info_.size);
  set_state(Connection::waiting, "waiting for a device", Clock::now());
  wait_until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(std::min(settings.wait_s, 1e8)));
  try_to_connect();
  if (!device_) {
    give_up_waiting();
    return;
  }
  info_.size = device_->size();
  info_.rate_hz = device_->rate_hz();
  info_.intrinsics = device_->intrinsics();
  info_.notes = device_->notes();
}

OpenNi2Source::~OpenNi2Source() {
  if (device_) on_openni2_thread([&] { device_.reset(); });
}

void OpenNi2Source::seek(std::int64_t) {
  throw std::logic_error("a live sensor has no other frame to go to");
}

SourceState OpenNi2Source::state() const {
  const std::lock_guard lock(mutex_);
  SourceState state = state_;
  if (away_since_) state.away_s += std::chrono::duration<double>(Clock::now() - *away_since_).count();
  return state;
}

void OpenNi2Source::set_state(Connection connection, const std::string& text, Clock::time_point since) {
  const std::lock_guard lock(mutex_);
  state_.connection = connection;
  state_.text = text;
  state_.since = since;
}

SensorValues OpenNi2Source::values() const {
  const std::lock_guard lock(mutex_);
  return values_;
}

std::vector<SensorMode> OpenNi2Source::modes() const {
  const std::lock_guard lock(mutex_);
  return modes_;
}

void OpenNi2Source::request(const SensorValues& wanted) {
  const std::lock_guard lock(mutex_);
  lay_over(wanted_, wanted);
  lay_over(requested_, wanted);
}

void OpenNi2Source::apply_requests() {
  SensorValues requested;
  {
    const std::lock_guard lock(mutex_);
    requested = std::exchange(requested_, {});
  }
  if (requested == SensorValues{}) return;
  on_openni2_thread([&] { device_->apply(requested); });
  const std::lock_guard lock(mutex_);
  values_ = device_->values();
  state_.notes = device_->notes();
}

void OpenNi2Source::interrupt() noexcept {
  const std::lock_guard lock(mutex_);
  interrupted_ = true;
  wake_.notify_all();
}

ReadResult OpenNi2Source::read(Frame& frame, milliseconds timeout) {
  const Clock::time_point deadline = Clock::now() + timeout;
  do {
    {
      const std::lock_guard lock(mutex_);
      if (std::exchange(interrupted_, false)) break;
    }
    if (!device_) {
      wait_for_device(deadline);
      if (runtime_.arrivals() != arrivals_ || Clock::now() >= next_try_) try_to_connect();
      if (device_)
        check_size();
      else
        give_up_waiting();
    } else if (std::optional<ReadResult> result = poll_device(frame, deadline)) {
      return *std::move(result);
    }
  } while (Clock::now() < deadline);
  return {ReadStatus::timeout, ""};
}

void OpenNi2Source::wait_for_device(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  wake_.wait_until(lock, std::min({deadline, next_try_, Clock::now() + kPoll}),
                   [this] { return interrupted_; });
}

// What comes first only: a device that was there once is waited for as long as it takes.
void OpenNi2Source::give_up_waiting() {
  if (last_device_ || Clock::now() < wait_until_) return;
  if (!last_failure_.empty()) throw unreadable(last_failure_, "", "");
  throw unreadable(wanted_uri_.empty() ? "no sensor is connected" : "this sensor is not connected", info_.uri,
                   kHint);
}

void OpenNi2Source::try_to_connect() {
  arrivals_ = runtime_.arrivals();
  next_try_ = Clock::now() + back_off_;
  back_off_ = std::min(2 * back_off_, kLongestBackOff);
  const auto devices = runtime_.devices();
  const int index = choose_device(devices, wanted_uri_, last_device_);
  if (index < 0) return;
  const DeviceIdentity& found = devices[static_cast<std::size_t>(index)];
  trouble_ = runtime_.trouble(found.uri).count;
  SensorValues wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = wanted_;
    requested_ = {};
  }
  try {
    on_openni2_thread([&] { device_ = std::make_unique<OpenNi2Device>(found, settings_, wanted); });
  } catch (const Error& error) {
    if (error.status() == ExitStatus::usage) throw;
    last_failure_ = error.what();
    return;
  }
  took_device();
}

// What info() has told holds.
void OpenNi2Source::check_size() const {
  if (device_->size() == info_.size) return;
  throw failed(fmt::format("the device gives {}x{}, not {}x{}", device_->size().width, device_->size().height,
                           info_.size.width, info_.size.height),
               name_of(device_->identity()),
               fmt::format("start again now that it is there, or with --mode {}x{}", device_->size().width,
                           device_->size().height));
}

void OpenNi2Source::took_device() {
  const bool first = !last_device_;
  last_device_ = device_->identity();
  last_failure_.clear();
  back_off_ = kFirstBackOff;
  pairing_.restart(1'000'000 / std::max(1, device_->rate_hz()), device_->has_colour());
  clock_.restart();
  opened_at_ = Clock::now();
  frames_since_opening_ = false;
  {
    const std::lock_guard lock(mutex_);
    values_ = device_->values();
    modes_ = device_->modes();
    state_.notes = device_->notes();
  }
  if (first) set_state(Connection::streaming, name_of(*last_device_), opened_at_);
}

std::optional<ReadResult> OpenNi2Source::poll_device(Frame& frame, Clock::time_point deadline) {
  if (bad_frame_) return reject(frame);
  apply_requests();
  if (const std::string why = reason_of_loss(); !why.empty()) {
    if (pairing_.has_depth()) return deliver(frame);
    lose(why);
    return ReadResult{ReadStatus::timeout, ""};  // at once, so that a short loss is seen, too
  }
  const milliseconds slice = std::clamp(time_left(deadline), milliseconds(0), kPoll);
  auto ready = OpenNi2Device::Ready::nothing;
  on_openni2_thread([&] { ready = device_->wait(slice); });
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
  std::string bad;
  on_openni2_thread([&] { bad = device_->read_depth(depth_, time_us); });
  came_back();
  std::optional<ReadResult> before;
  if (pairing_.has_depth()) before = deliver(frame);
  if (bad.empty())
    pairing_.put_depth(depth_, time_us);
  else
    bad_frame_ = BadFrame{time_us, std::move(bad)};
  return before;
}

void OpenNi2Source::take_colour() {
  std::int64_t time_us = 0;
  std::string bad;
  on_openni2_thread([&] { bad = device_->read_colour(colour_, time_us); });
  if (bad.empty()) pairing_.put_colour(colour_, time_us);
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
  frame.intrinsics = device_->intrinsics();
  frame.truth = {};
  if (taken.colour_missed) {
    const std::lock_guard lock(mutex_);
    ++state_.colourless;
  }
  return {ReadStatus::frame, ""};
}

std::string OpenNi2Source::reason_of_loss() const {
  const OpenNi2Runtime::Trouble trouble = runtime_.trouble(device_->identity().uri);
  if (trouble.count != trouble_) return trouble.text;
  const Clock::time_point heard = frames_since_opening_ ? last_frame_at_ : opened_at_;
  const milliseconds patience = frames_since_opening_ ? kSilence : kSilenceAfterOpening;
  if (Clock::now() - heard <= patience) return "";
  return fmt::format("it gives no depth for {} s", patience.count() / 1000);
}

void OpenNi2Source::lose(const std::string& why) {
  const std::string name = name_of(device_->identity());
  on_openni2_thread([&] { device_.reset(); });
  back_off_ = kFirstBackOff;
  next_try_ = Clock::now();
  if (!settings_.reconnect) throw failed("the sensor is lost: " + why, name, kHintOfLoss);
  const std::lock_guard lock(mutex_);
  values_ = {};
  state_.connection = Connection::lost;
  state_.text = fmt::format("{} is lost: {}", name, why);
  if (away_since_) return;  // it came back without a frame: this is still the same loss
  away_since_ = frames_since_opening_ ? last_frame_at_ : opened_at_;
  state_.since = *away_since_;
  ++state_.losses;
}

// A depth frame has come.
void OpenNi2Source::came_back() {
  last_frame_at_ = Clock::now();
  frames_since_opening_ = true;
  const std::lock_guard lock(mutex_);
  if (!away_since_) return;
  state_.away_s += std::chrono::duration<double>(last_frame_at_ - *away_since_).count();
  away_since_.reset();
  state_.connection = Connection::streaming;
  state_.text = name_of(*last_device_);
  state_.since = last_frame_at_;
}

}  // namespace saccade
