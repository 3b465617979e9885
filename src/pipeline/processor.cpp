#include "pipeline/processor.hpp"

namespace saccade {
namespace {

class Symmetry3dProcessor : public FrameProcessor {
 public:
  explicit Symmetry3dProcessor(const Settings& settings)
      : pool_(worker_count(settings)),
        operator_(Symmetry3dParams::from(settings), pool_, settings.simd),
        selector_(make_selector(settings)),
        wants_{settings.dump.contains("levels"), settings.dump.contains("normals")} {}

  void process(Result& result) override {
    const Frame& frame = result.frame;
    operator_.compute(frame.depth_mm, frame.intrinsics, wants_, result.maps, result.times);
    const StageTimer timer(result.times, Stage::attention);
    selector_->select(result.maps.master, frame.depth_mm, frame.intrinsics, result.attention);
  }

 private:
  WorkerPool pool_;
  Symmetry3d operator_;
  std::unique_ptr<AttentionSelector> selector_;
  SaliencyWants wants_;
};

}  // namespace

std::unique_ptr<FrameProcessor> make_processor(const Settings& settings) {
  return std::make_unique<Symmetry3dProcessor>(settings);
}

int worker_count(const Settings& settings) {
  return settings.workers > 0 ? settings.workers : processor_count();
}

}  // namespace saccade
