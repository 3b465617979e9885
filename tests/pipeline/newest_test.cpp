// The policy `newest`: what live work needs. Each test that waits does so for an event.
#include <condition_variable>
#include <mutex>
#include <random>

#include "pipeline_parts.hpp"

namespace saccade {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

PipelineOptions newest(int slots = 4) {
  PipelineOptions options;
  options.policy = FramePolicy::newest;
  options.slots = slots;
  return options;
}

// Permissions, given by one thread and taken by another.
class Steps {
 public:
  void give(int count = 1) {
    const std::lock_guard lock(mutex_);
    left_ += count;
    changed_.notify_all();
  }
  void take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return left_ > 0; });
    --left_;
  }
  bool take_within(milliseconds time) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, time, [this] { return left_ > 0; })) return false;
    --left_;
    return true;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int left_ = 0;
};

// Gives a frame for each permission, so that a test says when frames come.
class SteppedSource : public CountingSource {
 public:
  explicit SteppedSource(Steps& steps) : CountingSource(1'000'000), steps_(steps) { info_.live = true; }
  ReadResult read(Frame& frame, milliseconds timeout) override {
    if (!steps_.take_within(milliseconds(1))) return {ReadStatus::timeout, ""};
    return CountingSource::read(frame, timeout);
  }

 private:
  Steps& steps_;
};

// Says when it has begun a frame and goes on when told.
class SteppedProcessor : public CopyProcessor {
 public:
  SteppedProcessor(Steps& begun, Steps& go) : begun_(begun), go_(go) {}
  void process(Result& result) override {
    begun_.give();
    go_.take();
    CopyProcessor::process(result);
  }

 private:
  Steps &begun_, &go_;
};

void wait_for_captured(const Pipeline& pipeline, std::int64_t count) {
  while (pipeline.ledger().captured < count) std::this_thread::sleep_for(milliseconds(1));
}

TEST(PipelineNewest, WhileOneFrameIsComputedOnlyTheNewestOfTheOthersIsKept) {
  Steps steps, begun, go;
  Pipeline pipeline(std::make_unique<SteppedSource>(steps), std::make_unique<SteppedProcessor>(begun, go),
                    newest());
  steps.give();
  begun.take();  // frame 0 is being computed
  steps.give(5);
  wait_for_captured(pipeline, 6);
  go.give(2);
  for (const std::int64_t expected : {0, 5}) {
    const ResultHandle result = pipeline.next();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->frame.index, expected);
    EXPECT_EQ(result->maps.master(0, 0), static_cast<float>(expected));
  }
  const Ledger ledger = pipeline.ledger();
  EXPECT_EQ(ledger.replaced, 4);
  EXPECT_EQ(ledger.dropped, 4);
  EXPECT_EQ(ledger.processed, 2);
  EXPECT_EQ(pipeline.latency().count(), 2);
}

TEST(PipelineNewest, CaptureGoesOnWhileTheConsumerHoldsAllItMay) {
  Steps steps;
  Pipeline pipeline(std::make_unique<SteppedSource>(steps), std::make_unique<CopyProcessor>(), newest(4));
  std::vector<ResultHandle> held;
  for (int i = 0; i < 2; ++i) {
    steps.give();
    held.push_back(pipeline.next());
  }
  steps.give(10);  // compute has no slot for a result: it must not take one of these before it has
  wait_for_captured(pipeline, 12);
  held.clear();
  const ResultHandle result = pipeline.next();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->frame.index, 11) << "the newest, not one that waited for a slot";
  EXPECT_EQ(pipeline.ledger().replaced, 9);
}

TEST(PipelineNewest, TheLastFrameOfASourceThatEndsIsComputed) {
  for (int i = 0; i < 200; ++i) {
    Pipeline pipeline(std::make_unique<CountingSource>(50), std::make_unique<CopyProcessor>(), newest(3));
    std::int64_t last = -1;
    while (const ResultHandle result = pipeline.next()) {
      ASSERT_GT(result->frame.index, last) << "in order";
      last = result->frame.index;
    }
    ASSERT_EQ(last, 49);
    expect_balanced(pipeline.ledger());
    ASSERT_EQ(pipeline.ledger().stopped(), 0);
  }
}

TEST(PipelineNewest, TheLimitCountsResults) {
  PipelineOptions options = newest();
  options.frames.frames = 7;
  Pipeline pipeline(std::make_unique<CountingSource>(100'000'000),
                    std::make_unique<CopyProcessor>(microseconds(500)), options);
  int seen = 0;
  while (pipeline.next()) ++seen;
  EXPECT_EQ(seen, 7);
  EXPECT_EQ(pipeline.ledger().processed, 7);
  expect_balanced(pipeline.ledger());
}

TEST(PipelineNewest, EveryNthCountsFromTheFrameThatWasTaken) {
  Steps steps;
  PipelineOptions options = newest();
  options.frames = {2, 3, 0};
  Pipeline pipeline(std::make_unique<SteppedSource>(steps), std::make_unique<CopyProcessor>(), options);
  for (const std::int64_t expected : {2, 5, 8}) {
    steps.give(3);
    EXPECT_EQ(pipeline.next()->frame.index, expected);
  }
}

TEST(PipelineNewest, RefusesTooFewSlots) {
  EXPECT_THROW(Pipeline(std::make_unique<CountingSource>(1), std::make_unique<CopyProcessor>(), newest(2)),
               std::invalid_argument);
}

// A live source as they are: frames, nothing in time, bad frames, and at the end of its patience an error.
class MoodySource : public CountingSource {
 public:
  MoodySource(unsigned seed, std::int64_t fails_at) : CountingSource(1'000'000, {}, fails_at), dice_(seed) {
    info_.live = true;
  }
  ReadResult read(Frame& frame, milliseconds timeout) override {
    const unsigned throwing = dice_() % 16;
    if (throwing == 0) {
      std::this_thread::sleep_for(microseconds(dice_() % 300));
      return {ReadStatus::timeout, ""};
    }
    ReadResult read = CountingSource::read(frame, timeout);
    if (throwing == 1) return {ReadStatus::rejected, "bad"};
    if (throwing < 6) std::this_thread::sleep_for(microseconds(dice_() % 200));
    return read;
  }

 private:
  std::minstd_rand dice_;
};

// Runs one pipeline of either policy to an end that `seed` decides; the ledger is right at every moment.
void run_moody(FramePolicy policy, unsigned seed) {
  std::minstd_rand dice(seed);
  const auto chance = [&](unsigned n) { return dice() % n == 0; };
  PipelineOptions options;
  options.policy = policy;
  options.slots = static_cast<int>(3 + dice() % 4);
  options.frames.frames = chance(4) ? 1 + dice() % 40 : 0;
  std::atomic<std::int64_t> rejected = 0;
  options.on_rejected = [&](std::int64_t, const std::string&) { ++rejected; };
  const std::int64_t source_fails = chance(4) ? dice() % 100 : -1,
                     processor_fails = chance(4) ? dice() % 100 : -1;
  const microseconds pace(chance(2) ? 0 : dice() % 1500), stop_after(dice() % 8000);
  Pipeline pipeline(std::make_unique<MoodySource>(dice(), source_fails),
                    std::make_unique<CopyProcessor>(pace, processor_fails), options);
  const LedgerWatch watch(pipeline, options.slots);
  std::jthread stopper([&] {
    std::this_thread::sleep_for(stop_after);
    pipeline.stop();
    pipeline.stop();
  });
  std::int64_t seen = 0, last = -1;
  try {
    while (const ResultHandle result = pipeline.next()) {
      ASSERT_GT(result->frame.index, last);
      last = result->frame.index;
      ASSERT_EQ(result->maps.master(7, 7), static_cast<float>(last)) << "nobody wrote into it";
      ++seen;
    }
  } catch (const Error&) {
    EXPECT_TRUE(source_fails >= 0 || processor_fails >= 0);
  }
  const Ledger ledger = pipeline.ledger();
  expect_balanced(ledger);
  EXPECT_EQ(ledger.processed, seen) << "what was computed is handed out";
  EXPECT_EQ(ledger.rejected, rejected);
  EXPECT_EQ(pipeline.latency().count(), seen);
  if (policy == FramePolicy::every_frame) {
    EXPECT_EQ(ledger.replaced, 0);
  }
}

TEST(PipelineStress, StoppedAtAnyMomentTheLedgerBalances) {
  for (unsigned seed = 1; seed <= 300; ++seed)
    for (const FramePolicy policy : {FramePolicy::newest, FramePolicy::every_frame}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      ASSERT_NO_FATAL_FAILURE(run_moody(policy, seed));
    }
}

TEST(PipelineStress, IsDestroyedAtAnyMomentWithoutAConsumer) {
  for (unsigned i = 0; i < 200; ++i) {
    Pipeline pipeline(std::make_unique<MoodySource>(i + 1, -1), std::make_unique<CopyProcessor>(),
                      newest(3 + static_cast<int>(i % 3)));
    if (i % 2) pipeline.next();
    if (i % 5 == 0) std::this_thread::sleep_for(microseconds(i * 5));
  }
}

}  // namespace
}  // namespace saccade
