#include "pipeline/pipeline.hpp"

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;

// Frames whose depth is their index; some are rejected, some fail.
class CountingSource : public FrameSource {
 public:
  explicit CountingSource(std::int64_t count, std::set<std::int64_t> rejected = {},
                          std::int64_t fails_at = -1)
      : rejected_(std::move(rejected)), fails_at_(fails_at) {
    info_.size = {8, 8};
    info_.frame_count = count;
  }

  const SourceInfo& info() const override { return info_; }

  ReadResult read(Frame& frame, milliseconds) override {
    if (next_ >= *info_.frame_count) return {ReadStatus::end, ""};
    if (next_ == fails_at_) throw failed("source failed", "here", "nothing");
    frame.index = next_++;
    frame.depth_mm.create(8, 8);
    frame.depth_mm = static_cast<float>(frame.index);
    if (rejected_.contains(frame.index)) return {ReadStatus::rejected, "bad"};
    return {ReadStatus::frame, ""};
  }

  void seek(std::int64_t index) override { next_ = index; }

 private:
  SourceInfo info_;
  std::int64_t next_ = 0;
  std::set<std::int64_t> rejected_;
  std::int64_t fails_at_;
};

// A live source that gives one frame and then nothing, ever.
class SilentSource : public CountingSource {
 public:
  SilentSource() : CountingSource(1) {}
  ReadResult read(Frame& frame, milliseconds timeout) override {
    const ReadResult result = CountingSource::read(frame, timeout);
    if (result.status == ReadStatus::frame) return result;
    std::this_thread::sleep_for(milliseconds(1));
    return {ReadStatus::timeout, ""};
  }
};

class CopyProcessor : public FrameProcessor {
 public:
  explicit CopyProcessor(milliseconds delay = {}, std::int64_t fails_at = -1)
      : delay_(delay), fails_at_(fails_at) {}
  void process(Result& result) override {
    if (result.frame.index == fails_at_) throw failed("processor failed", "here", "nothing");
    std::this_thread::sleep_for(delay_);
    result.frame.depth_mm.copyTo(result.maps.master);
  }

 private:
  milliseconds delay_;
  std::int64_t fails_at_;
};

std::vector<std::int64_t> indices(Pipeline& pipeline) {
  std::vector<std::int64_t> seen;
  while (const ResultHandle result = pipeline.next()) {
    EXPECT_EQ(result->maps.master(3, 3), static_cast<float>(result->frame.index));
    seen.push_back(result->frame.index);
  }
  return seen;
}

void expect_balanced(const Ledger& ledger) { EXPECT_EQ(ledger.in_flight(), 0); }

TEST(Pipeline, GivesEveryFrameInOrder) {
  Pipeline pipeline(std::make_unique<CountingSource>(500), std::make_unique<CopyProcessor>(), {});
  const auto seen = indices(pipeline);
  ASSERT_EQ(seen.size(), 500U);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<std::int64_t>(i));
  EXPECT_EQ(pipeline.ledger(), (Ledger{500, 500, 0, 0}));
  EXPECT_FALSE(pipeline.next()) << "the end stays the end";
}

TEST(Pipeline, TakesStartEveryAndLimit) {
  PipelineOptions options;
  options.selection = {5, 10, 4};
  Pipeline pipeline(std::make_unique<CountingSource>(100), std::make_unique<CopyProcessor>(), options);
  EXPECT_EQ(indices(pipeline), (std::vector<std::int64_t>{5, 15, 25, 35}));
}

TEST(Pipeline, RejectedFramesAreCountedNamedAndPassedOver) {
  PipelineOptions options;
  std::vector<std::int64_t> rejected;
  options.on_rejected = [&](std::int64_t index, const std::string& reason) {
    EXPECT_EQ(reason, "bad");
    rejected.push_back(index);
  };
  Pipeline pipeline(std::make_unique<CountingSource>(10, std::set<std::int64_t>{0, 3, 9}),
                    std::make_unique<CopyProcessor>(), options);
  EXPECT_EQ(indices(pipeline), (std::vector<std::int64_t>{1, 2, 4, 5, 6, 7, 8}));
  EXPECT_EQ(pipeline.ledger(), (Ledger{10, 7, 0, 3}));
  EXPECT_EQ(rejected, (std::vector<std::int64_t>{0, 3, 9}));
}

TEST(Pipeline, BackPressureHoldsCaptureWhileTheConsumerHoldsResults) {
  PipelineOptions options;
  options.slots = 3;
  Pipeline pipeline(std::make_unique<CountingSource>(100), std::make_unique<CopyProcessor>(), options);
  {
    std::vector<ResultHandle> held;
    for (int i = 0; i < 3; ++i) held.push_back(pipeline.next());
    std::this_thread::sleep_for(milliseconds(30));
    EXPECT_EQ(pipeline.ledger().captured, 3) << "only as many frames as slots";
  }
  EXPECT_EQ(indices(pipeline).size(), 97U);
}

TEST(Pipeline, HandlesMayBeGivenBackOnAnyThread) {
  Pipeline pipeline(std::make_unique<CountingSource>(300), std::make_unique<CopyProcessor>(), {});
  std::vector<std::jthread> givers;  // join before the pipeline goes
  std::int64_t expected = 0;
  while (ResultHandle result = pipeline.next()) {
    EXPECT_EQ(result->frame.index, expected++);
    givers.emplace_back([held = std::move(result)]() mutable { held.reset(); });
  }
  EXPECT_EQ(expected, 300);
}

TEST(Pipeline, ErrorsOfEitherThreadComeAfterTheResultsBeforeThem) {
  for (const bool source_fails : {true, false}) {
    Pipeline pipeline(std::make_unique<CountingSource>(100, std::set<std::int64_t>{}, source_fails ? 20 : -1),
                      std::make_unique<CopyProcessor>(milliseconds(0), source_fails ? -1 : 20), {});
    std::int64_t seen = 0;
    try {
      while (const ResultHandle result = pipeline.next()) EXPECT_EQ(result->frame.index, seen++);
      ADD_FAILURE() << "no error came";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(source_fails ? "source failed" : "processor failed"),
                std::string::npos);
    }
    EXPECT_LE(seen, 20);
    if (!source_fails) {
      EXPECT_EQ(seen, 20);
    }
    expect_balanced(pipeline.ledger());
  }
}

TEST(Pipeline, StopAtAnyMomentEndsWithABalancedLedger) {
  for (int delay_us = 0; delay_us < 6000; delay_us += 250) {
    Pipeline pipeline(std::make_unique<CountingSource>(1'000'000),
                      std::make_unique<CopyProcessor>(milliseconds(1)), {});
    std::jthread stopper([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(delay_us));
      pipeline.stop();
      pipeline.stop();
    });
    const auto seen = static_cast<std::int64_t>(indices(pipeline).size());
    expect_balanced(pipeline.ledger());
    EXPECT_EQ(pipeline.ledger().processed, seen) << "what was computed is handed out";
  }
}

TEST(Pipeline, IsDestroyedInTheMiddleWithoutAConsumer) {
  for (int i = 0; i < 50; ++i) {
    Pipeline pipeline(std::make_unique<CountingSource>(1'000'000), std::make_unique<CopyProcessor>(), {});
    if (i % 2) pipeline.next();
  }
}

TEST(Pipeline, StopsWhileALiveSourceIsSilent) {
  Pipeline pipeline(std::make_unique<SilentSource>(), std::make_unique<CopyProcessor>(), {});
  ASSERT_TRUE(pipeline.next());
  std::jthread stopper([&] { pipeline.stop(); });
  EXPECT_FALSE(pipeline.next());
  expect_balanced(pipeline.ledger());
}

TEST(Pipeline, OverridesIntrinsics) {
  PipelineOptions options;
  options.intrinsics = Intrinsics{1, 2, 3, 4, IntrinsicsOrigin::option};
  Pipeline pipeline(std::make_unique<CountingSource>(1), std::make_unique<CopyProcessor>(), options);
  const ResultHandle result = pipeline.next();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->frame.intrinsics.fy, 2);
  EXPECT_EQ(result->frame.intrinsics.origin, IntrinsicsOrigin::option);
}

TEST(Pipeline, RefusesOptionsOutOfRange) {
  PipelineOptions options;
  options.slots = 1;
  EXPECT_THROW(Pipeline(std::make_unique<CountingSource>(1), std::make_unique<CopyProcessor>(), options),
               std::invalid_argument);
}

}  // namespace
}  // namespace saccade
