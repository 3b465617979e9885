#include "ui/session/session.hpp"

#include <exception>
#include <utility>

#include "pipeline/paced_source.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSlots = 4;  // one each: captured, waiting, computed, shown

}  // namespace

Session::Session(Open open, std::function<void()> wake, ComputeRequest request)
    : open_(std::move(open)), wake_(std::move(wake)), compute_request_(std::move(request)) {
  thread_ = std::jthread([this](const std::stop_token& token) { work(token); });
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    stop_pipeline();
  }
  thread_.request_stop();
}

void Session::open(OpenRequest request) {
  {
    const std::lock_guard lock(mutex_);
    state_ = {};
    state_.phase = SessionState::Phase::opening;
    state_.uri = request.uri;
    to_open_ = std::move(request);
    latest_.reset();
    records_.clear();
    stop_pipeline();
  }
  asked_.notify_all();
}

// With mutex_ held.
void Session::stop_pipeline() {
  if (pipeline_ == nullptr) return;
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
  SessionState state = state_;
  if (pipeline_ != nullptr && !to_open_) {
    state.ledger = pipeline_->ledger();
    state.connection = pipeline_->source_state();
  }
  return state;
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

std::vector<FrameRecord> Session::take_records() {
  const std::lock_guard lock(mutex_);
  return std::exchange(records_, {});
}

// The session's thread: one source after the other.
void Session::work(const std::stop_token& token) {
  for (;;) {
    OpenRequest request;
    {
      std::unique_lock lock(mutex_);
      if (!asked_.wait(lock, token, [this] { return to_open_.has_value(); })) return;
      if (stopping_) return;
      request = *std::exchange(to_open_, std::nullopt);
    }
    std::string error;
    try {
      run(request);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    change([&](SessionState& state) {
      state.phase = SessionState::Phase::ended;
      state.error = error;
    });
  }
}

void Session::run(const OpenRequest& request) {
  std::unique_ptr<FrameSource> source = open_(request.uri, request.sensor);
  const SourceInfo info = source->info();
  check_start(info, request.range.start);
  SensorControls* const controls = source->controls();
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

  std::unique_lock lock(mutex_);
  if (to_open_ || stopping_) return;  // another source is wanted, or none
  auto processor = std::make_unique<InteractiveProcessor>(
      compute_request_, generation_,
      InteractiveProcessor::Hooks{
          [this] { playback_->taken(); },
          [this](std::shared_ptr<ViewResult> result) { publish(std::move(result)); }});
  InteractiveProcessor* const processing = processor.get();
  state_.source = info;
  state_.phase = SessionState::Phase::open;
  Pipeline pipeline(std::make_unique<PacedSource>(std::move(source), playback_, request.range),
                    std::move(processor), std::move(options));
  pipeline_ = &pipeline;
  processor_ = processing;
  controls_ = controls;
  lock.unlock();
  wake_();

  std::exception_ptr error;
  try {
    consume(pipeline);
  } catch (...) {
    error = std::current_exception();
  }
  lock.lock();
  if (!to_open_) state_.ledger = pipeline.ledger();
  pipeline_ = nullptr;
  processor_ = nullptr;
  controls_ = nullptr;
  lock.unlock();
  if (error) std::rethrow_exception(error);
}

// The processor publishes results; this loop returns their slots and rethrows the pipeline's errors.
void Session::consume(Pipeline& pipeline) {
  while (const ResultHandle result = pipeline.next()) {
    const std::lock_guard lock(mutex_);
    if (!to_open_) state_.latency = pipeline.latency();
  }
}

void Session::publish(std::shared_ptr<ViewResult> result) {
  FrameRecord record;
  record.index = result->frame().index;
  record.generation = result->generation;
  if (const auto& fixations = result->a.result.attention.fixations; !fixations.empty())
    record.strength = fixations.front().saliency;
  record.times = result->a.result.times;
  record.at = Clock::now();
  record.latency_ms =
      std::chrono::duration<double, std::milli>(record.at - result->a.result.captured_at).count();
  {
    const std::lock_guard lock(mutex_);
    if (to_open_ || stopping_) return;
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
    if (to_open_) return;  // about a source that is being replaced
    how(state_);
  }
  wake_();
}

}  // namespace saccade
