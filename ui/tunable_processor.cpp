#include "ui/tunable_processor.hpp"

#include <sys/resource.h>

#include <exception>
#include <utility>
#include <vector>

#include "saliency/params.hpp"

namespace saccade {
namespace {

constexpr int kNice = 5;  // computation steps back when the window has something to do

bool same_model(const Settings& a, const Settings& b) {
  return a.model == b.model && a.kernel == b.kernel && a.first_level == b.first_level &&
         a.last_level == b.last_level && a.length_scale == b.length_scale &&
         a.normalisation == b.normalisation && a.simd == b.simd;
}

bool same_selector(const Settings& a, const Settings& b) {
  return a.selector == b.selector && a.fixations == b.fixations && a.foa == b.foa;
}

}  // namespace

// One model and one selector, remade when the settings say so.
class TunableProcessor::Engine {
 public:
  explicit Engine(WorkerPool& pool) : pool_(pool) {}

  // `out.result.frame` is filled.
  void compute(Settings settings, SaliencyWants wants, Computed& out) {
    const Frame& frame = out.result.frame;
    settings.last_level = last_level_for(settings, frame.size());
    out.settings = settings;
    out.error.clear();
    try {
      prepare(settings, frame.size());
      model_->compute(frame, wants, out.result.maps, out.result.times);
      const StageTimer timer(out.result.times, Stage::attention);
      selector_->select(out.result.maps.master, frame.depth_mm, frame.intrinsics, out.result.attention);
    } catch (const std::exception& error) {
      out.error = error.what();
      out.result.maps.master.create(frame.size());
      out.result.maps.master.setTo(0);
      out.result.maps.levels.clear();
      out.result.maps.normals.release();
      out.result.attention = {};
    }
    out.smooth = smooth_for_looking(out.result.maps.master);
    out.outlines = proto_outlines(out.result.attention);
  }

 private:
  void prepare(const Settings& settings, cv::Size image) {
    Settings checked = settings;
    checked.dump.clear();  // what is wanted besides the map is left empty where a model does not have it
    check_model(checked, image);
    if (!model_ || !same_model(settings, made_)) model_ = make_model(settings, pool_);
    if (!selector_ || !same_selector(settings, made_)) selector_ = make_selector(settings);
    made_ = settings;
  }

  WorkerPool& pool_;
  std::unique_ptr<SaliencyModel> model_;
  std::unique_ptr<AttentionSelector> selector_;
  Settings made_;
};

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
}

void TunableProcessor::process(Result& result) {
  hooks_.begun();
  const std::shared_ptr<ViewResult> view = Pool::take(results_);
  Wishes wishes;
  {
    const std::lock_guard lock(mutex_);
    wishes = wishes_;
    view->generation = generation_;
  }
  if (!workers_) {
    ::setpriority(PRIO_PROCESS, 0, kNice);  // of this thread, and so of those that it starts
    workers_ = std::make_unique<WorkerPool>(worker_count(wishes.a));
    a_ = std::make_unique<Engine>(*workers_);
    b_ = std::make_unique<Engine>(*workers_);
  }
  Result& a = view->a.result;
  copy_frame(result.frame, a.frame);
  a.times = result.times;
  a.captured_at = result.captured_at;
  a_->compute(wishes.a, wishes.wants, view->a);
  view->compared = wishes.b.has_value();
  if (wishes.b) {
    Result& b = view->b.result;
    b.frame = a.frame;
    b.times = {};
    b.captured_at = a.captured_at;
    b_->compute(*wishes.b, wishes.wants, view->b);
  }
  result.times = a.times;
  hooks_.publish(view);
}

}  // namespace saccade
