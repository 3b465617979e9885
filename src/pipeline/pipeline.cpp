#include "pipeline/pipeline.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

namespace saccade {
namespace {

constexpr std::chrono::milliseconds kReadTimeout{100};

// Room for every slot, the end mark and one wish to stop: a push never waits.
std::size_t ring_capacity(const PipelineOptions& options) {
  if (options.slots < 2 || options.selection.every < 1 || options.selection.start < 0)
    throw std::invalid_argument("Pipeline: slots >= 2, every >= 1 and start >= 0 expected");
  return static_cast<std::size_t>(options.slots) + 2;
}

}  // namespace

void ReturnSlot::operator()(Result* result) const {
  if (result != nullptr) pipeline->give_back(result);
}

Pipeline::Pipeline(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor,
                   PipelineOptions options)
    : source_(std::move(source)),
      processor_(std::move(processor)),
      options_(std::move(options)),
      free_(ring_capacity(options_)),
      captured_(ring_capacity(options_)),
      computed_(ring_capacity(options_)) {
  for (int i = 0; i < options_.slots; ++i) {
    slots_.push_back(std::make_unique<Result>());
    free_.push(slots_.back().get());
  }
  compute_thread_ = std::jthread([this] { compute(); });
  capture_thread_ = std::jthread([this] { capture(); });
}

Pipeline::~Pipeline() {
  stop();
  capture_thread_.join();
  compute_thread_.join();
}

ResultHandle Pipeline::next() {
  if (!ended_) {
    if (Result* slot = computed_.pop()) return {slot, ReturnSlot{this}};
    ended_ = true;
  }
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return {nullptr, ReturnSlot{this}};
}

void Pipeline::stop() noexcept {
  if (stopping_.exchange(true)) return;
  source_->interrupt();
  give_back(nullptr);  // wakes a capture that waits for a slot
}

Ledger Pipeline::ledger() const {
  const std::lock_guard lock(mutex_);
  return ledger_;
}

void Pipeline::give_back(Result* slot) noexcept {
  const std::lock_guard lock(give_back_mutex_);
  free_.push(slot);
}

void Pipeline::fail(std::exception_ptr error) noexcept {
  {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  stop();
}

void Pipeline::count(std::int64_t Ledger::*field) noexcept {
  const std::lock_guard lock(mutex_);
  ++(ledger_.*field);
}

void Pipeline::capture() noexcept {
  try {
    capture_frames();
  } catch (...) {
    fail(std::current_exception());
  }
  captured_.push(nullptr);
}

void Pipeline::capture_frames() {
  const FrameSelection& selection = options_.selection;
  const bool seekable = !source_->info().live;
  std::int64_t wanted = selection.start, taken = 0;
  bool at_wanted = wanted == 0;
  Result* slot = free_.pop();
  while (slot != nullptr && !stopping_ && (selection.limit == 0 || taken < selection.limit)) {
    if (seekable && !at_wanted) source_->seek(wanted);
    slot->times = {};
    const ReadResult read = read_into(*slot);
    if (read.status == ReadStatus::end) return;
    if (read.status == ReadStatus::timeout) continue;
    if (!seekable && slot->frame.index < wanted) continue;
    const std::int64_t index = slot->frame.index;
    wanted += selection.every;
    at_wanted = selection.every == 1;
    ++taken;
    count(&Ledger::captured);
    if (read.status == ReadStatus::rejected) {
      count(&Ledger::rejected);
      if (options_.on_rejected) options_.on_rejected(index, read.reason);
      continue;
    }
    captured_.push(slot);
    slot = free_.pop();
  }
}

ReadResult Pipeline::read_into(Result& slot) {
  const StageTimer timer(slot.times, Stage::capture);
  ReadResult read = source_->read(slot.frame, kReadTimeout);
  if (options_.intrinsics) slot.frame.intrinsics = *options_.intrinsics;
  return read;
}

void Pipeline::compute() noexcept {
  while (Result* slot = captured_.pop()) {
    if (stopping_) {
      count(&Ledger::dropped);
      continue;
    }
    try {
      processor_->process(*slot);
    } catch (...) {
      count(&Ledger::dropped);
      fail(std::current_exception());
      continue;
    }
    count(&Ledger::processed);
    computed_.push(slot);
  }
  computed_.push(nullptr);
}

}  // namespace saccade
