#include "pipeline/processor.hpp"

#include "core/worker_pool.hpp"
#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"

namespace saccade {
namespace {

class ModelProcessor : public FrameProcessor {
 public:
  explicit ModelProcessor(const ProcessorOptions& options)
      : pool_(options.workers),
        model_(make_model(options.model, pool_)),
        selector_(make_selector(options.attention)),
        outputs_(options.outputs) {}

  void process(Result& result) override {
    const Frame& frame = result.frame;
    model_->compute(frame, outputs_, result.maps, result.times);
    const StageTimer timer(result.times, Stage::attention);
    selector_->select(result.maps.master, frame.depth_mm, frame.intrinsics, result.attention);
  }

 private:
  WorkerPool pool_;
  std::unique_ptr<SaliencyModel> model_;
  std::unique_ptr<AttentionSelector> selector_;
  RequestedOutputs outputs_;
};

// Surfaces and camera motion are computed beside the map.
class TrackingProcessor : public FrameProcessor {
 public:
  explicit TrackingProcessor(const ProcessorOptions& options)
      : pool_(options.workers),
        model_(make_model(options.model, pool_)),
        tracker_(options.attention.fixations, options.attention.min_confidence, *options.tracking),
        outputs_(options.outputs) {}

  void process(Result& result) override {
    const Frame& frame = result.frame;
    follower_.start(frame);
    try {
      model_->compute(frame, outputs_, result.maps, result.times);
    } catch (...) {
      follower_.wait();
      throw;
    }
    const StageTimer timer(result.times, Stage::attention);
    follower_.wait();
    tracker_.attend(frame, result.maps.master, follower_.surfaces(), follower_.step(), result.attention);
  }

 private:
  WorkerPool pool_;
  std::unique_ptr<SaliencyModel> model_;
  FrameFollower follower_;
  AttentionTracker tracker_;
  RequestedOutputs outputs_;
};

}  // namespace

std::unique_ptr<FrameProcessor> make_processor(const ProcessorOptions& options) {
  if (options.tracking) return std::make_unique<TrackingProcessor>(options);
  return std::make_unique<ModelProcessor>(options);
}

}  // namespace saccade
