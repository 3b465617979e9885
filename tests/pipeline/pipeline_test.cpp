#include "pipeline/pipeline.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "pipeline_parts.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;

// A live source that gives one frame and then no more.
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

std::vector<std::int64_t> indices(Pipeline& pipeline) {
  std::vector<std::int64_t> seen;
  while (const ResultHandle result = pipeline.next()) {
    EXPECT_EQ(result->maps.master(3, 3), static_cast<float>(result->frame.index));
    seen.push_back(result->frame.index);
  }
  return seen;
}

TEST(Pipeline, GivesEveryFrameInOrder) {
  Pipeline pipeline(std::make_unique<CountingSource>(500), std::make_unique<CopyProcessor>(), {});
  const auto seen = indices(pipeline);
  ASSERT_EQ(seen.size(), 500U);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<std::int64_t>(i));
  EXPECT_EQ(pipeline.ledger(), (Ledger{500, 500, 0, 0}));
  EXPECT_FALSE(pipeline.next()) << "it stays at the end";
}

TEST(Pipeline, TakesStartEveryAndLimit) {
  PipelineOptions options;
  options.frames = {5, 10, 4};
  Pipeline pipeline(std::make_unique<CountingSource>(100), std::make_unique<CopyProcessor>(), options);
  EXPECT_EQ(indices(pipeline), (std::vector<std::int64_t>{5, 15, 25, 35}));
}

// A sensor that drops some frames by itself: it gives those of these indices.
class LiveSource : public CountingSource {
 public:
  explicit LiveSource(std::vector<std::int64_t> given)
      : CountingSource(std::ssize(given)), given_(std::move(given)) {
    info_.live = true;
  }
  ReadResult read(Frame& frame, milliseconds timeout) override {
    const ReadResult result = CountingSource::read(frame, timeout);
    if (result.status == ReadStatus::frame) {
      frame.index = given_[static_cast<std::size_t>(frame.index)];
      frame.depth_mm = static_cast<float>(frame.index);
    }
    return result;
  }
  void seek(std::int64_t) override { ADD_FAILURE() << "a live source cannot seek"; }

 private:
  std::vector<std::int64_t> given_;
};

TEST(Pipeline, OfALiveSourceTooItTakesStartAndEvery) {
  PipelineOptions options;
  options.frames = {2, 3, 0};
  Pipeline pipeline(std::make_unique<LiveSource>(std::vector<std::int64_t>{0, 1, 2, 3, 4, 8, 9, 11, 12, 20}),
                    std::make_unique<CopyProcessor>(), options);
  EXPECT_EQ(indices(pipeline), (std::vector<std::int64_t>{2, 8, 11, 20}))
      << "three later than the one before";
}

TEST(Pipeline, RejectedFramesAreCountedReportedAndSkipped) {
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

TEST(Pipeline, HandlesMayBeReturnedOnAnyThread) {
  Pipeline pipeline(std::make_unique<CountingSource>(300), std::make_unique<CopyProcessor>(), {});
  std::vector<std::jthread> givers;  // join before the pipeline is destroyed
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
      ADD_FAILURE() << "no error was thrown";
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

// Gives one frame, then waits until it is interrupted, and fails.
class FailsWhenInterrupted : public CountingSource {
 public:
  FailsWhenInterrupted() : CountingSource(1) {}
  ReadResult read(Frame& frame, milliseconds timeout) override {
    const ReadResult result = CountingSource::read(frame, timeout);
    if (result.status == ReadStatus::frame) return result;
    interrupted_.wait(false);
    throw failed("interrupted", "the device", "");
  }
  void interrupt() noexcept override {
    interrupted_ = true;
    interrupted_.notify_all();
  }

 private:
  std::atomic<bool> interrupted_ = false;
};

TEST(Pipeline, OfSeveralErrorsTheFirstIsReported) {
  Pipeline pipeline(std::make_unique<FailsWhenInterrupted>(),
                    std::make_unique<CopyProcessor>(milliseconds(0), 0), {});
  try {
    while (pipeline.next()) {
    }
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "processor failed: here (nothing)");
  }
}

// More than there are slots, none of which may be lost.
TEST(Pipeline, FramesThatTheModelCannotUseAreRejectedAndTheRestGoesOn) {
  class Refuses : public CopyProcessor {
   public:
    void process(Result& result) override {
      if (result.frame.index % 10 != 0) throw unreadable("no colour", "", "");
      CopyProcessor::process(result);
    }
  };
  PipelineOptions options;
  std::vector<std::int64_t> rejected;
  options.on_rejected = [&](std::int64_t index, const std::string& reason) {
    EXPECT_EQ(reason, "no colour");
    rejected.push_back(index);
  };
  Pipeline pipeline(std::make_unique<CountingSource>(31), std::make_unique<Refuses>(), options);
  EXPECT_EQ(indices(pipeline), (std::vector<std::int64_t>{0, 10, 20, 30}));
  EXPECT_EQ(pipeline.ledger(), (Ledger{31, 4, 0, 27}));
  EXPECT_EQ(rejected.size(), 27U);
}

TEST(Pipeline, LatencyCountsFromTheCapture) {
  Pipeline pipeline(std::make_unique<CountingSource>(1), std::make_unique<CopyProcessor>(milliseconds(20)),
                    {});
  ASSERT_TRUE(pipeline.next());
  EXPECT_GE(pipeline.latency().max_ms(), 20);
  EXPECT_LT(pipeline.latency().max_ms(), 60'000) << "the clock itself began earlier";
}

// Is changed by somebody else after it was read once.
class CounterThatMoves {
 public:
  static inline std::function<void()> then;

  void fetch_add(std::int64_t by) { value_ += by; }
  operator std::int64_t() const {
    const std::int64_t value = value_;
    if (then) std::exchange(then, nullptr)();
    return value;
  }

 private:
  std::int64_t value_ = 0;
};

TEST(LedgerCounters, ALedgerIsOfOneMomentWhateverIsCountedMeanwhile) {
  LedgerCountersOf<CounterThatMoves> counters;
  counters.count(counters.captured);
  CounterThatMoves::then = [&] {  // one more frame, from beginning to end
    counters.count(counters.captured);
    counters.count(counters.processed);
  };
  const Ledger ledger = counters.snapshot();
  EXPECT_EQ(ledger.in_flight(), 1);
  EXPECT_EQ(ledger.captured, 2);
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
    EXPECT_EQ(pipeline.ledger().processed, seen) << "every computed frame is handed out";
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
  options.frames.intrinsics = Intrinsics{1, 2, 3, 4, IntrinsicsOrigin::option};
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
