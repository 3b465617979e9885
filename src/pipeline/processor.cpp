#include "pipeline/processor.hpp"

#include "models/model.hpp"

namespace saccade {
namespace {

class ModelProcessor : public FrameProcessor {
 public:
  explicit ModelProcessor(const Settings& settings)
      : pool_(worker_count(settings)),
        model_(make_model(settings, pool_)),
        selector_(make_selector(settings)),
        outputs_{settings.dump.contains("levels"), settings.dump.contains("normals")} {}

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

}  // namespace

std::unique_ptr<FrameProcessor> make_processor(const Settings& settings) {
  return std::make_unique<ModelProcessor>(settings);
}

int worker_count(const Settings& settings) {
  return settings.workers > 0 ? settings.workers : processor_count();
}

}  // namespace saccade
