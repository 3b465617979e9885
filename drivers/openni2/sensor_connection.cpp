#include "drivers/openni2/sensor_connection.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "drivers/openni2/openni2_devices.hpp"
#include "drivers/openni2/openni2_thread.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;
using Connection = SourceState::Connection;

constexpr milliseconds kSilence{2000}, kSilenceAfterOpening{5000};
constexpr milliseconds kFirstBackOff{100}, kLongestBackOff{2000};
constexpr std::string_view kSerial = "serial=";  // before a serial number in place of a URI
constexpr const char* kHintOfAbsence = "plug in a sensor; saccade doctor looks for the reason";
constexpr const char* kHintOfLoss = "plug it in again; without --no-reconnect Saccade waits for it";

SensorValues values_of(const SensorSettings& settings) {
  SensorValues values;
  values.registration = settings.registration;
  values.mirror = settings.mirror;
  values.auto_exposure = !settings.exposure;
  values.exposure = settings.exposure;
  values.auto_white_balance = settings.auto_white_balance;
  return values;
}

// Overwrites `to` with the values that `from` has.
void overwrite(SensorValues& to, const SensorValues& from) {
  const auto set = [](auto& a, const auto& b) {
    if (b) a = b;
  };
  set(to.registration, from.registration);
  set(to.mirror, from.mirror);
  set(to.auto_exposure, from.auto_exposure);
  set(to.exposure, from.exposure);
  set(to.auto_white_balance, from.auto_white_balance);
}

std::chrono::steady_clock::time_point after(double seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr double kForever_s = 1e8;
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::min(seconds, kForever_s)));
}

}  // namespace

SensorConnection::SensorConnection(std::string device, const SensorSettings& settings)
    : settings_(settings),
      wanted_(std::move(device)),
      runtime_(OpenNi2Runtime::instance()),
      wait_until_(after(settings.wait_s)),
      back_off_(kFirstBackOff),
      wanted_values_(values_of(settings)) {
  set_state(Connection::waiting, "waiting for a device", Clock::now());
  try_to_connect();
}

SensorConnection::~SensorConnection() {
  if (device_) on_openni2_thread([&] { device_.reset(); });
}

std::string SensorConnection::name() const {
  const DeviceIdentity& device = last_device_.value();
  return fmt::format("{} {} ({})", device.vendor, device.name, device.uri);
}

bool SensorConnection::try_to_connect() {
  if (runtime_.arrivals() != arrivals_ || Clock::now() >= next_try_) open_found();
  if (!device_) give_up();
  return device_ != nullptr;
}

void SensorConnection::open_found() {
  arrivals_ = runtime_.arrivals();
  next_try_ = Clock::now() + back_off_;
  back_off_ = std::min(2 * back_off_, kLongestBackOff);
  const auto devices = runtime_.devices();
  const int index = choose(devices);
  if (index < 0) return;
  const DeviceIdentity& found = devices[static_cast<std::size_t>(index)];
  trouble_ = runtime_.trouble(found.uri).count;
  SensorValues wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = wanted_values_;
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

// The position of the device to open; -1 = it is not there.
int SensorConnection::choose(const std::vector<DeviceIdentity>& devices) const {
  if (!wanted_.starts_with(kSerial)) return choose_device(devices, wanted_, last_device_);
  const std::string serial = wanted_.substr(kSerial.size());
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (serial_of(devices[i]) == serial) return static_cast<int>(i);
  return -1;
}

void SensorConnection::took_device() {
  const bool first = !last_device_;
  last_device_ = device_->identity();
  last_failure_.reset();
  back_off_ = kFirstBackOff;
  opened_at_ = Clock::now();
  heard_since_opening_ = false;
  {
    const std::lock_guard lock(mutex_);
    values_ = device_->values();
    modes_ = device_->modes();
    state_.notes = device_->notes();
  }
  if (first) set_state(Connection::streaming, name(), opened_at_);
}

// Throws if the first device has not come in time.
void SensorConnection::give_up() const {
  if (last_device_ || Clock::now() < wait_until_) return;
  if (last_failure_) throw unreadable(*last_failure_, "", "");
  throw wanted_.empty() ? unreadable("no sensor is connected", "openni2", kHintOfAbsence)
                        : unreadable("this sensor is not connected", "openni2:" + wanted_,
                                     "saccade devices lists the sensors with their serial numbers");
}

std::optional<std::string> SensorConnection::reason_of_loss() const {
  const OpenNi2Runtime::Trouble trouble = runtime_.trouble(last_device_->uri);
  if (trouble.count != trouble_) return trouble.text;
  const milliseconds patience = heard_since_opening_ ? kSilence : kSilenceAfterOpening;
  if (Clock::now() - last_heard() <= patience) return std::nullopt;
  return fmt::format("it gives no depth for {} s", patience.count() / 1000);
}

void SensorConnection::lose(const std::string& why) {
  on_openni2_thread([&] { device_.reset(); });
  back_off_ = kFirstBackOff;
  next_try_ = Clock::now();
  if (!settings_.reconnect) throw failed("the sensor is lost: " + why, name(), kHintOfLoss);
  const std::lock_guard lock(mutex_);
  values_ = {};
  state_.connection = Connection::lost;
  state_.text = fmt::format("{} is lost: {}", name(), why);
  if (away_since_) return;  // it came back without a frame: this is still the same loss
  away_since_ = last_heard();
  state_.since = *away_since_;
  ++state_.losses;
}

void SensorConnection::apply_requests() {
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

void SensorConnection::note_depth() {
  last_depth_at_ = Clock::now();
  heard_since_opening_ = true;
  const std::lock_guard lock(mutex_);
  if (!away_since_) return;
  state_.away_s += std::chrono::duration<double>(last_depth_at_ - *away_since_).count();
  away_since_.reset();
  state_.connection = Connection::streaming;
  state_.text = name();
  state_.since = last_depth_at_;
}

void SensorConnection::note_colourless() {
  const std::lock_guard lock(mutex_);
  ++state_.colourless;
}

SourceState SensorConnection::state() const {
  const std::lock_guard lock(mutex_);
  SourceState state = state_;
  if (away_since_) state.away_s += std::chrono::duration<double>(Clock::now() - *away_since_).count();
  return state;
}

void SensorConnection::set_state(Connection connection, const std::string& text, Clock::time_point since) {
  const std::lock_guard lock(mutex_);
  state_.connection = connection;
  state_.text = text;
  state_.since = since;
}

SensorValues SensorConnection::values() const {
  const std::lock_guard lock(mutex_);
  return values_;
}

std::vector<SensorMode> SensorConnection::modes() const {
  const std::lock_guard lock(mutex_);
  return modes_;
}

void SensorConnection::request(const SensorValues& wanted) {
  const std::lock_guard lock(mutex_);
  overwrite(wanted_values_, wanted);
  overwrite(requested_, wanted);
}

}  // namespace saccade
