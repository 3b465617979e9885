#include "ui/tunable_processor.hpp"

#include <sys/resource.h>

#include <utility>
#include <vector>

namespace saccade {
namespace {

constexpr int kNice = 5;  // computation steps back when the window has something to do

bool same_frame(const Frame& a, const Frame& b) {
  return a.index == b.index && a.timestamp_us == b.timestamp_us && a.size() == b.size();
}

bool same_camera(const Intrinsics& a, const Intrinsics& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

Intrinsics camera_of(const Frame& frame, const Settings& settings) {
  return settings.intrinsics.value_or(frame.intrinsics);
}

}  // namespace

// Results that nobody holds any more, to be filled again.
class TunableProcessor::Pool {
 public:
  static std::shared_ptr<ViewResult> take(const std::shared_ptr<Pool>& pool) {
    std::unique_ptr<ViewResult> result;
    {
      const std::lock_guard lock(pool->mutex_);
      if (!pool->spare_.empty()) {
        result = std::move(pool->spare_.back());
        pool->spare_.pop_back();
      }
    }
    if (!result) result = std::make_unique<ViewResult>();
    return {result.release(), [pool](ViewResult* r) {
              std::unique_ptr<ViewResult> owned(r);
              const std::lock_guard lock(pool->mutex_);
              pool->spare_.push_back(std::move(owned));
            }};
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<ViewResult>> spare_;
};

TunableProcessor::TunableProcessor(Wishes wishes, std::int64_t generation, Hooks hooks)
    : hooks_(std::move(hooks)),
      wishes_(std::move(wishes)),
      generation_(generation),
      results_(std::make_shared<Pool>()) {}

TunableProcessor::~TunableProcessor() = default;

void TunableProcessor::set_wishes(Wishes wishes, std::int64_t generation) {
  const std::lock_guard lock(mutex_);
  wishes_ = std::move(wishes);
  generation_ = generation;
  if (slow_) workers_->interrupt();
}

void TunableProcessor::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  if (workers_) workers_->interrupt();
}

void TunableProcessor::start(const Settings& settings) {
  ::setpriority(PRIO_PROCESS, 0, kNice);  // of this thread, and so of those that it starts
  const std::lock_guard lock(mutex_);
  workers_ = std::make_unique<WorkerPool>(worker_count(settings));
  for (std::unique_ptr<Engine>* engine : {&a_, &b_, &draft_a_, &draft_b_})
    *engine = std::make_unique<Engine>(*workers_);
}

// The newest wishes; false if they ask for nothing that is not published yet.
bool TunableProcessor::take_wishes(const Frame& frame, Wishes& wishes, std::int64_t& generation) {
  const std::lock_guard lock(mutex_);
  wishes = wishes_;
  generation = generation_;
  return !stopped_ && (!last_ || last_->generation != generation || !same_frame(last_->frame(), frame));
}

// From here on what is computed may be given up; false if it is to be given up already.
bool TunableProcessor::begin_slow(std::int64_t generation) {
  const std::lock_guard lock(mutex_);
  slow_ = generation == generation_;
  return slow_;
}

void TunableProcessor::end_slow() {
  const std::lock_guard lock(mutex_);
  slow_ = false;
  if (!stopped_) workers_->resume();
}

void TunableProcessor::process(Result& result) {
  hooks_.begun();
  Wishes wishes;
  std::int64_t generation = 0;
  while (take_wishes(result.frame, wishes, generation)) {
    if (!workers_) start(wishes.a);
    const bool known = known_ && same_frame(known_->frame(), result.frame) &&
                       same_camera(known_->frame().intrinsics, camera_of(result.frame, wishes.a));
    if (!known) known_.reset();
    const auto slow = [&](const Settings& settings, Computed ViewResult::*side) {
      return draft_of(settings, result.frame.size()) &&
             !(known_ && has_maps(*known_.*side, settings, wishes.wants));
    };
    try {
      const bool any_slow = slow(wishes.a, &ViewResult::a) || (wishes.b && slow(*wishes.b, &ViewResult::b));
      if (any_slow && (!last_ || last_->generation != generation)) {
        const auto draft = compute(result, wishes, generation, Part::draft);
        known_ = draft;
        hooks_.publish(draft);
      }
      if (any_slow && !begin_slow(generation)) continue;
      const auto whole = compute(result, wishes, generation, Part::whole);
      result.times = whole->a.result.times;
      known_ = last_ = whole;
      hooks_.publish(whole);
    } catch (const WorkerPool::Interrupted&) {  // there are newer wishes, or none at all
    }
    end_slow();
  }
  hooks_.ended();
}

std::shared_ptr<ViewResult> TunableProcessor::compute(const Result& result, const Wishes& wishes,
                                                      std::int64_t generation, Part part) {
  const std::shared_ptr<ViewResult> view = Pool::take(results_);
  view->draft = part == Part::draft;
  view->generation = generation;
  view->compared = wishes.b.has_value();
  Result& a = view->a.result;
  copy_frame(result.frame, a.frame);
  a.frame.intrinsics = camera_of(result.frame, wishes.a);
  a.times = result.times;
  a.captured_at = result.captured_at;
  const auto fill = [&](Engine& whole, Engine& draft, Settings settings, const Computed* known,
                        Computed& out) {
    const bool has = known != nullptr && has_maps(*known, settings, wishes.wants);
    const auto reduced = view->draft && !has ? draft_of(settings, a.frame.size()) : std::nullopt;
    out.draft = reduced.has_value();
    (reduced ? draft : whole).compute(reduced.value_or(settings), wishes.wants, known, out);
  };
  fill(*a_, *draft_a_, wishes.a, known_ ? &known_->a : nullptr, view->a);
  if (wishes.b) {
    Result& b = view->b.result;
    b.frame = a.frame;
    b.times = {};
    b.captured_at = a.captured_at;
    fill(*b_, *draft_b_, *wishes.b, known_ && known_->compared ? &known_->b : nullptr, view->b);
  }
  return view;
}

}  // namespace saccade
