#include "ui/session/session.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "pipeline/paced_source.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSlots = 4;  // one each: captured, waiting, computed, shown

ExitStatus status_of(const std::exception& error) {
  const auto* ours = dynamic_cast<const Error*>(&error);
  return ours != nullptr ? ours->status() : ExitStatus::failed;
}

}  // namespace

Session::Session(Open open, std::function<void()> wake, ComputeRequest request)
    : open_(std::move(open)), wake_(std::move(wake)), compute_request_(std::move(request)) {
  opener_ = std::jthread([this](const std::stop_token& token) { work(token); });
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    stop_pipeline();
  }
  opener_.request_stop();
  opener_.join();
}

void Session::open(OpenRequest request) {
  {
    const std::lock_guard lock(mutex_);
    state_.opening = request.uri;
    to_open_ = std::move(request);
  }
  asked_.notify_all();
}

// With mutex_ held.
void Session::stop_pipeline() {
  if (!pipeline_) return;
  pipeline_->stop();
  processor_->stop();
}

std::int64_t Session::set_compute_request(const ComputeRequest& request) {
  std::int64_t generation = 0;
  {
    const std::lock_guard lock(mutex_);
    compute_request_ = request;
    generation = ++generation_;
    if (processor_ != nullptr) processor_->set_compute_request(request, generation);
  }
  playback_->show_again();
  return generation;
}

SessionState Session::state() const {
  const std::lock_guard lock(mutex_);
  return state_now();
}

// With mutex_ held.
SessionState Session::state_now() const {
  SessionState state = state_;
  if (pipeline_) {
    state.ledger = pipeline_->ledger();
    state.connection = pipeline_->source_state();
  }
  return state;
}

SessionUpdate Session::poll() {
  const std::lock_guard lock(mutex_);
  return {state_now(), latest_, std::exchange(records_, {})};
}

SensorValues Session::sensor_values() const {
  const std::lock_guard lock(mutex_);
  return controls_ == nullptr ? SensorValues{} : controls_->values();
}

std::vector<SensorMode> Session::sensor_modes() const {
  const std::lock_guard lock(mutex_);
  return controls_ == nullptr ? std::vector<SensorMode>{} : controls_->modes();
}

void Session::request_sensor(const SensorValues& wanted) {
  const std::lock_guard lock(mutex_);
  if (controls_ != nullptr) controls_->request(wanted);
}

ViewResultPtr Session::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

// The opening thread: one source after the other.
void Session::work(const std::stop_token& token) {
  for (;;) {
    OpenRequest request;
    {
      std::unique_lock lock(mutex_);
      if (!asked_.wait(lock, token, [this] { return to_open_.has_value(); }) || stopping_) break;
      request = *std::exchange(to_open_, std::nullopt);
    }
    std::string failure;
    ExitStatus failure_status = ExitStatus::done;
    try {
      replace_source(request);
    } catch (const std::exception& error) {
      failure = error.what();
      failure_status = status_of(error);
    }
    change([&](SessionState& state) {
      if (!to_open_) state.opening.clear();
      if (failure.empty()) return;
      ++state.failed;
      state.failure = failure;
      state.failure_status = failure_status;
    });
  }
  stop_running();
}

// Throws if the source cannot be opened.
void Session::replace_source(const OpenRequest& request) {
  const std::optional<OpenRequest> closed = close_if_same_device(request);
  std::unique_ptr<FrameSource> source;
  try {
    source = open_(request.uri, request.sensor);
    check_start(source->info(), request.range.start);
    if (closed && request.uri != closed->uri &&
        source->state().connection == SourceState::Connection::waiting)
      throw unreadable("this sensor is not connected", request.uri, "saccade devices lists the sensors");
  } catch (const std::exception&) {
    source.reset();
    if (closed) start(open_(closed->uri, closed->sensor), *closed);
    throw;
  }
  {
    const std::lock_guard lock(mutex_);
    if (stopping_ || (to_open_ && !closed)) return;  // another source is wanted, or none
  }
  start(std::move(source), request);
}

// Two programs, or two parts of one, cannot use a sensor at the same time. Returns the request of the sensor
// that this closed.
std::optional<OpenRequest> Session::close_if_same_device(const OpenRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    const std::string& kind = state_.source.kind;
    const bool same_kind = request.uri == kind || request.uri.starts_with(kind + ":");
    const bool any = request.uri == kind || present_.uri == kind;  // "openni2": whichever is connected
    const bool same = request.uri == present_.uri || (same_kind && any);
    if (!pipeline_ || !state_.source.live || !same) return std::nullopt;
  }
  stop_running();
  return present_;
}

// Ends the present source, if there is one, and starts this one.
void Session::start(std::unique_ptr<FrameSource> source, const OpenRequest& request) {
  stop_running();
  playback_->set_tap({});  // a recording holds one source
  const SourceInfo info = source->info();
  PipelineOptions options;
  options.policy = FramePolicy::newest;
  options.slots = kSlots;
  if (info.live) options.frames = {request.range.start, request.range.every, request.range.limit};
  options.on_rejected = [this](std::int64_t index, const std::string& reason) {
    change([&](SessionState& state) {
      state.rejected_index = index;
      state.rejected_reason = reason;
    });
  };
  present_ = request;
  {
    const std::lock_guard lock(mutex_);
    SessionState state;
    state.phase = SessionState::Phase::open;
    state.opening = state_.opening;
    state.opened = state_.opened + 1;
    state.failed = state_.failed;
    state.failure = state_.failure;
    state.failure_status = state_.failure_status;
    state.uri = request.uri;
    state.source = info;
    state_ = std::move(state);
    latest_.reset();
    records_.clear();
    replacing_ = false;
    controls_ = source->controls();
    auto processor = std::make_unique<InteractiveProcessor>(
        compute_request_, generation_, info.sequence,
        InteractiveProcessor::Hooks{
            [this] { playback_->taken(); },
            [this](std::shared_ptr<ViewResult> result) { publish(std::move(result)); },
            [this] { return playback_->last_jump(); }});
    processor_ = processor.get();
    pipeline_ =
        std::make_unique<Pipeline>(std::make_unique<PacedSource>(std::move(source), playback_, request.range),
                                   std::move(processor), std::move(options));
    if (stopping_) stop_pipeline();
    runner_ = std::jthread([this, &pipeline = *pipeline_] { run(pipeline); });
  }
  wake_();
}

// Ends the pipeline and waits until its source is closed.
void Session::stop_running() {
  {
    const std::lock_guard lock(mutex_);
    replacing_ = true;
    stop_pipeline();
  }
  if (runner_.joinable()) runner_.join();
}

// The thread of one source, from its start to its end.
void Session::run(Pipeline& pipeline) {
  std::string error;
  ExitStatus error_status = ExitStatus::done;
  try {
    consume(pipeline);
  } catch (const std::exception& failure) {
    error = failure.what();
    error_status = status_of(failure);
  }
  std::unique_ptr<Pipeline> ended;  // destroyed without the lock: it waits for its threads
  {
    const std::lock_guard lock(mutex_);
    state_.ledger = pipeline.ledger();
    processor_ = nullptr;
    controls_ = nullptr;
    ended = std::move(pipeline_);
    if (!replacing_) {
      state_.phase = SessionState::Phase::ended;
      state_.error = error;
      state_.error_status = error_status;
    }
  }
  ended.reset();
  wake_();
}

// The processor publishes results; this loop returns their slots and rethrows the pipeline's errors.
void Session::consume(Pipeline& pipeline) {
  while (const ResultHandle result = pipeline.next()) {
    const std::lock_guard lock(mutex_);
    state_.latency = pipeline.latency();
  }
}

void Session::publish(std::shared_ptr<ViewResult> result) {
  FrameRecord record;
  record.index = result->frame().index;
  record.generation = result->generation;
  double largest = 0;
  cv::minMaxLoc(result->a.result.maps.master, nullptr, &largest);
  record.strength = static_cast<float>(largest);
  record.times = result->a.result.times;
  record.at = Clock::now();
  record.latency_ms =
      std::chrono::duration<double, std::milli>(record.at - result->a.result.captured_at).count();
  {
    const std::lock_guard lock(mutex_);
    if (replacing_ || stopping_) return;
    result->serial = ++serial_;
    result->computed = result->draft ? computed_ : ++computed_;
    if (!result->draft) {
      if (records_.size() == kMostRecords)
        records_.erase(records_.begin(), records_.begin() + kMostRecords / 2);
      records_.push_back(record);
    }
    latest_ = std::move(result);
  }
  wake_();
}

void Session::change(const std::function<void(SessionState&)>& how) {
  {
    const std::lock_guard lock(mutex_);
    how(state_);
  }
  wake_();
}

}  // namespace saccade
