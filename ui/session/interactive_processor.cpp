#include "ui/session/interactive_processor.hpp"

#include <sys/resource.h>

#include <utility>
#include <vector>

namespace saccade {
namespace {

constexpr int kNicer = 5;  // than the window: computation steps back when there is something to draw

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

// Keeps results that nobody holds any more, with their memory, for later frames.
class InteractiveProcessor::Pool {
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

InteractiveProcessor::InteractiveProcessor(ComputeRequest request, std::int64_t generation, bool sequence,
                                           Hooks hooks)
    : sequence_(sequence),
      hooks_(std::move(hooks)),
      request_(std::move(request)),
      generation_(generation),
      results_(std::make_shared<Pool>()) {}

InteractiveProcessor::~InteractiveProcessor() = default;

void InteractiveProcessor::set_compute_request(ComputeRequest request, std::int64_t generation) {
  const std::lock_guard lock(mutex_);
  request_ = std::move(request);
  generation_ = generation;
  if (slow_) workers_->interrupt();
}

void InteractiveProcessor::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  if (workers_) workers_->interrupt();
}

void InteractiveProcessor::start(const Settings& settings) {
  // For this thread, and thereby for those that it starts.
  ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kNicer);
  const std::lock_guard lock(mutex_);
  workers_ = std::make_unique<WorkerPool>(worker_count(settings));
  for (std::unique_ptr<ModelRunner>* runner : {&a_, &b_, &draft_a_, &draft_b_})
    *runner = std::make_unique<ModelRunner>(*workers_);
}

// The newest request; false if its result of this frame is published already.
bool InteractiveProcessor::take_request(const Frame& frame, ComputeRequest& request,
                                        std::int64_t& generation) {
  const std::lock_guard lock(mutex_);
  request = request_;
  generation = generation_;
  return !stopped_ && (!last_ || last_->generation != generation || !same_frame(last_->frame(), frame));
}

// From now on a newer request interrupts the computation; false if there is one already.
bool InteractiveProcessor::begin_slow(std::int64_t generation) {
  const std::lock_guard lock(mutex_);
  slow_ = generation == generation_;
  return slow_;
}

void InteractiveProcessor::end_slow() {
  const std::lock_guard lock(mutex_);
  slow_ = false;
  if (!stopped_) workers_->resume();
}

bool InteractiveProcessor::tracks(const Settings& settings) const {
  return settings.selector == Selector::proto && saccade::tracks(settings, settings.selector, sequence_, "");
}

// A frame from before the last jump may still come after it. (After a jump back the index says it.)
bool InteractiveProcessor::is_after_jump(const Frame& frame) {
  const PlayJump jump = hooks_.last_jump ? hooks_.last_jump() : PlayJump{};
  if (jump.count == jumps_ || frame.index < jump.index) return false;
  jumps_ = jump.count;
  return true;
}

// Starts to compute the surfaces and the camera's motion of a new frame.
void InteractiveProcessor::follow(const Frame& frame, const ComputeRequest& request) {
  const Intrinsics camera = camera_of(frame, request.a);
  const bool known = followed_ && followed_->index == frame.index &&
                     followed_->timestamp_us == frame.timestamp_us && followed_->size == frame.size() &&
                     same_camera(followed_->camera, camera);
  if (known || !(tracks(request.a) || (request.b && tracks(*request.b)))) return;
  finish_following();
  if (!follower_) follower_ = std::make_unique<FrameFollower>();
  a_memory_.next_frame();
  b_memory_.next_frame();
  ++followed_count_;
  followed_.emplace(Followed{frame.index, frame.timestamp_us, frame.size(), camera, frame, true, {}});
  followed_->frame.intrinsics = camera;
  follower_->start(followed_->frame, is_after_jump(frame));
}

// Waits for what follow() has started, and lets the pixels go, whose memory takes later frames.
void InteractiveProcessor::finish_following() noexcept {
  if (!followed_ || !followed_->busy) return;
  try {
    follower_->wait();
  } catch (...) {
    followed_->error = std::current_exception();
  }
  followed_->busy = false;
  followed_->frame = Frame{};
}

void InteractiveProcessor::attend(SequenceMemory& memory, const SequenceMemory& other, Computed& computed) {
  finish_following();
  if (followed_->error) std::rethrow_exception(followed_->error);
  memory.attend(*follower_, followed_count_, other, computed);
}

void InteractiveProcessor::process(Result& result) {
  struct AtEnd {
    InteractiveProcessor& processor;
    ~AtEnd() { processor.finish_following(); }
  } const at_end{*this};
  hooks_.begun();
  ComputeRequest request;
  std::int64_t generation = 0;
  while (take_request(result.frame, request, generation)) {
    if (!workers_) start(request.a);
    follow(result.frame, request);
    const bool known = known_ && same_frame(known_->frame(), result.frame) &&
                       same_camera(known_->frame().intrinsics, camera_of(result.frame, request.a));
    if (!known) known_.reset();
    const auto slow = [&](const Settings& settings, Computed ViewResult::*side) {
      return draft_of(settings, result.frame.size()) &&
             !(known_ && has_maps(*known_.*side, settings, request.outputs));
    };
    try {
      const bool any_slow =
          slow(request.a, &ViewResult::a) || (request.b && slow(*request.b, &ViewResult::b));
      if (any_slow && (!last_ || last_->generation != generation)) {
        const auto draft = compute(result, request, generation, Part::draft);
        known_ = draft;
        hooks_.publish(draft);
      }
      if (any_slow && !begin_slow(generation)) continue;
      const auto whole = compute(result, request, generation, Part::whole);
      result.times = whole->a.result.times;
      known_ = last_ = whole;
      hooks_.publish(whole);
    } catch (const WorkerPool::Interrupted&) {  // there is a newer request, or the end has come
    }
    end_slow();
  }
}

std::shared_ptr<ViewResult> InteractiveProcessor::compute(const Result& result, const ComputeRequest& request,
                                                          std::int64_t generation, Part part) {
  std::shared_ptr<ViewResult> view = Pool::take(results_);
  view->draft = part == Part::draft;
  view->generation = generation;
  view->compared = request.b.has_value();
  Result& a = view->a.result;
  copy_frame(result.frame, a.frame);
  a.frame.intrinsics = camera_of(result.frame, request.a);
  a.times = result.times;
  a.captured_at = result.captured_at;
  const auto fill = [&](ModelRunner& whole, ModelRunner& draft, const Settings& settings,
                        const Computed* known, SequenceMemory& memory, Computed& out) {
    const SequenceMemory& other = &memory == &a_memory_ ? b_memory_ : a_memory_;
    const ModelRunner::Attend over_time = [&](Computed& computed) { attend(memory, other, computed); };
    const bool has = known != nullptr && has_maps(*known, settings, request.outputs);
    const auto reduced = view->draft && !has ? draft_of(settings, a.frame.size()) : std::nullopt;
    out.draft = reduced.has_value();
    (reduced ? draft : whole)
        .compute(reduced.value_or(settings), request.outputs, known, out,
                 tracks(settings) ? over_time : ModelRunner::Attend());
  };
  fill(*a_, *draft_a_, request.a, known_ ? &known_->a : nullptr, a_memory_, view->a);
  if (request.b) {
    Result& b = view->b.result;
    b.frame = a.frame;
    b.times = {};
    b.captured_at = a.captured_at;
    fill(*b_, *draft_b_, *request.b, known_ && known_->compared ? &known_->b : nullptr, b_memory_, view->b);
  }
  const auto followed = [](Computed& side) { return side.marks ? &side : nullptr; };
  SequenceMemory::number_objects(a_memory_, followed(view->a), b_memory_,
                                 request.b ? followed(view->b) : nullptr);
  return view;
}

}  // namespace saccade
