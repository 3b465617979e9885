#include "pipeline/pipeline.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kReadTimeout{100};

std::vector<std::unique_ptr<Result>> make_slots(const PipelineOptions& options) {
  const int least = options.policy == FramePolicy::newest ? 3 : 2;
  if (options.slots < least || options.frames.every < 1 || options.frames.start < 0)
    throw std::invalid_argument("Pipeline: slots >= 2 (newest: 3), every >= 1 and start >= 0 expected");
  std::vector<std::unique_ptr<Result>> slots(static_cast<std::size_t>(options.slots));
  for (auto& slot : slots) slot = std::make_unique<Result>();
  return slots;
}

}  // namespace

void ReturnSlot::operator()(Result* result) const {
  if (result != nullptr) pipeline->give_back(result);
}

// Each ring has room for every slot, the end mark and a stop request, so that a push never waits.
Pipeline::Pipeline(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor,
                   PipelineOptions options)
    : source_(std::move(source)),
      processor_(std::move(processor)),
      options_(std::move(options)),
      slots_(make_slots(options_)),
      free_(slots_.size() + 2),
      captured_(slots_.size() + 2),
      computed_(slots_.size() + 2),
      newest_(slots_[0].get()),
      notifier_(*source_, options_.on_state) {
  // With `newest`, two slots are in use from the start: one in the mailbox, one in capture.
  for (std::size_t i = keeps_newest() ? 2 : 0; i < slots_.size(); ++i) free_.push(slots_[i].get());
  compute_thread_ = std::jthread([this] { compute(); });
  try {
    capture_thread_ = std::jthread([this] { capture(); });
  } catch (...) {  // the system has no more threads: the other one must end before it is joined
    stop();
    if (keeps_newest())
      newest_.close();
    else
      captured_.push(nullptr);
    throw;
  }
}

Pipeline::~Pipeline() {
  stop();
  capture_thread_.join();
  compute_thread_.join();
}

ResultHandle Pipeline::next() {
  if (!ended_) {
    if (Result* slot = computed_.pop()) {
      latency_.add(std::chrono::duration<double, std::milli>(Clock::now() - slot->captured_at).count());
      return {slot, ReturnSlot{this}};
    }
    ended_ = true;
  }
  const std::lock_guard lock(error_mutex_);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return {nullptr, ReturnSlot{this}};
}

void Pipeline::stop() noexcept {
  if (stopping_.exchange(true)) return;
  source_->interrupt();
  give_back(nullptr);  // wakes the thread that waits for a slot
}

void Pipeline::give_back(Result* slot) noexcept {
  const std::lock_guard lock(give_back_mutex_);
  free_.push(slot);
}

void Pipeline::fail(std::exception_ptr error) noexcept {
  {
    const std::lock_guard lock(error_mutex_);
    if (!error_) error_ = std::move(error);
  }
  stop();
}

void Pipeline::capture() noexcept {
  try {
    capture_frames();
  } catch (...) {
    fail(std::current_exception());
  }
  if (keeps_newest())
    newest_.close();
  else
    captured_.push(nullptr);
}

void Pipeline::capture_frames() {
  const FrameSettings& selection = options_.frames;
  const bool seekable = !source_->info().live;
  const std::int64_t limit = keeps_newest() ? 0 : selection.frames;
  std::int64_t wanted = selection.start, taken = 0;
  bool at_wanted = wanted == 0;
  Result* slot = keeps_newest() ? slots_[1].get() : free_.pop();
  while (slot != nullptr && !stopping_ && (limit == 0 || taken < limit)) {
    if (seekable && !at_wanted) source_->seek(wanted);
    slot->times = {};
    const ReadResult read = read_into(*slot);
    if (read.status == ReadStatus::end) return;
    notifier_.after_read(read.status);
    if (read.status == ReadStatus::timeout) continue;
    if (!seekable && slot->frame.index < wanted) continue;
    const std::int64_t index = slot->frame.index;
    wanted = (seekable ? wanted : index) + selection.every;
    at_wanted = selection.every == 1;
    ++taken;
    counters_.count(LedgerCounters::captured);
    if (read.status == ReadStatus::rejected) {
      reject(index, read.reason);
      continue;
    }
    if (!read.reason.empty() && options_.on_incomplete) options_.on_incomplete(index, read.reason);
    slot = hand_over(slot);
  }
}

ReadResult Pipeline::read_into(Result& slot) {
  const StageTimer timer(slot.times, Stage::capture);
  ReadResult read = source_->read(slot.frame, kReadTimeout);
  slot.captured_at = Clock::now();
  if (options_.frames.intrinsics) slot.frame.intrinsics = *options_.frames.intrinsics;
  return read;
}

// Gives a captured frame to the compute thread; returns the slot for the next one, null to end.
Result* Pipeline::hand_over(Result* slot) {
  if (!keeps_newest()) {
    captured_.push(slot);
    return free_.pop();
  }
  const auto [next, replaced] = newest_.put(slot);
  if (replaced) counters_.count(LedgerCounters::replaced);
  return next;
}

void Pipeline::compute() noexcept {
  Result* spare = keeps_newest() ? free_.pop() : nullptr;
  while (Result* slot = keeps_newest() ? newest_.take(spare) : captured_.pop()) {
    const Processing outcome = stopping_ ? Processing::failed : process(*slot);
    if (outcome != Processing::done) {
      if (outcome == Processing::failed) counters_.count(LedgerCounters::stopped);
      // The slot takes the next frame: from here with `newest`, else by way of the capture thread.
      if (keeps_newest())
        spare = slot;
      else if (outcome == Processing::rejected)
        give_back(slot);
      continue;
    }
    counters_.count(LedgerCounters::processed);
    computed_.push(slot);
    if (!keeps_newest()) continue;
    if (++results_ == options_.frames.frames) stop();
    spare = free_.pop();  // null only when stopped: capture then ends, whatever it gets for it
  }
  computed_.push(nullptr);
}

void Pipeline::reject(std::int64_t index, const std::string& reason) {
  counters_.count(LedgerCounters::rejected);
  if (options_.on_rejected) options_.on_rejected(index, reason);
}

Pipeline::Processing Pipeline::process(Result& slot) noexcept {
  try {
    try {
      processor_->process(slot);
      return Processing::done;
    } catch (const Error& error) {
      if (error.status() != ExitStatus::unreadable) throw;
      reject(slot.frame.index, error.what());
      return Processing::rejected;
    }
  } catch (...) {
    fail(std::current_exception());
    return Processing::failed;
  }
}

}  // namespace saccade
