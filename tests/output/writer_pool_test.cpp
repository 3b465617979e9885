#include "output/writer_pool.hpp"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

#include "pipeline/pipeline.hpp"

namespace saccade {
namespace {

class ThirtyFrames : public FrameSource {
 public:
  const SourceInfo& info() const override { return info_; }
  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    frame.index = next_++;
    return {frame.index < 30 ? ReadStatus::frame : ReadStatus::end, ""};
  }
  void seek(std::int64_t index) override { next_ = index; }

 private:
  SourceInfo info_;
  std::int64_t next_ = 0;
};

class Idle : public FrameProcessor {
  void process(Result&) override {}
};

TEST(WriterPool, WritesEveryResultOnceWithAnyNumberOfThreads) {
  for (const int threads : {0, 1, 3}) {
    Pipeline pipeline(std::make_unique<ThirtyFrames>(), std::make_unique<Idle>(), {});
    std::vector<std::atomic<int>> written(30);
    WriterPool pool(threads,
                    [&](const Result& result) { ++written[static_cast<std::size_t>(result.frame.index)]; });
    while (ResultHandle result = pipeline.next()) pool.submit(std::move(result));
    pool.finish();
    for (const auto& count : written) EXPECT_EQ(count, 1);
  }
}

TEST(WriterPool, TheFirstErrorReachesTheCaller) {
  for (const int threads : {0, 2}) {
    Pipeline pipeline(std::make_unique<ThirtyFrames>(), std::make_unique<Idle>(), {});
    WriterPool pool(threads, [&](const Result& result) {
      if (result.frame.index == 5) throw std::runtime_error("disk");
    });
    EXPECT_THROW(
        {
          while (ResultHandle result = pipeline.next()) pool.submit(std::move(result));
          pool.finish();
        },
        std::runtime_error);
  }
}

}  // namespace
}  // namespace saccade
