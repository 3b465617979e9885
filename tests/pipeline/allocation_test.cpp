// A running pipeline allocates no memory for a frame.
#include "pipeline_parts.hpp"
#include "tests/support/allocations.hpp"

namespace saccade {
namespace {

// Two boxes before a wall, each frame the same.
class BoxesSource : public CountingSource {
 public:
  BoxesSource() : CountingSource(1'000'000'000), scene_(96, 128, 2000.0F) {
    info_.size = scene_.size();
    scene_(cv::Rect(20, 20, 30, 30)) = 1200.0F;
    scene_(cv::Rect(80, 40, 24, 40)) = 900.0F;
  }
  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    frame.index = next_++;
    scene_.copyTo(frame.depth_mm);
    frame.intrinsics = Intrinsics::guess_for(scene_.size());
    return {ReadStatus::frame, ""};
  }

 private:
  cv::Mat1f scene_;
};

class PipelineMemory : public ::testing::Test {
 protected:
  // The number of allocations for `frames` results after the first ones.
  static std::int64_t cost(Pipeline& pipeline, int frames) {
    for (int i = 0; i < 100; ++i) pipeline.next();
    const std::int64_t before = allocations();
    for (int i = 0; i < frames; ++i) pipeline.next();
    return allocations() - before;
  }

  static PipelineOptions options(FramePolicy policy) {
    PipelineOptions options;
    options.policy = policy;
    options.on_state = [](const SourceState&) {};
    return options;
  }
};

TEST_F(PipelineMemory, NothingIsAllocatedPerFrame) {
  for (const FramePolicy policy : {FramePolicy::every_frame, FramePolicy::newest}) {
    Pipeline pipeline(std::make_unique<CountingSource>(1'000'000'000), std::make_unique<CopyProcessor>(),
                      options(policy));
    EXPECT_EQ(cost(pipeline, 1000), 0);
  }
}

TEST_F(PipelineMemory, NothingIsAllocatedByTheOperatorAndTheSelectors) {
  ProcessorOptions processor;
  processor.model.kernel = 5;
  processor.model.last_level = 1;
  processor.workers = 2;
  for (const Selector selector : {Selector::wta, Selector::proto}) {
    processor.attention.selector = selector;
    Pipeline pipeline(std::make_unique<BoxesSource>(), make_processor(processor),
                      options(FramePolicy::every_frame));
    EXPECT_EQ(cost(pipeline, 100), 0) << static_cast<int>(selector);
  }
}

}  // namespace
}  // namespace saccade
