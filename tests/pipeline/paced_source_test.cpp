#include "pipeline/paced_source.hpp"

#include <functional>
#include <utility>

#include <gtest/gtest.h>

#include "pipeline_parts.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;

// Time passes only in wait().
class FakeClock : public PlayClock {
 public:
  Time now() override { return now_; }
  void wait(std::unique_lock<std::mutex>&, std::condition_variable&, Time until) override { now_ = until; }
  double seconds() const { return std::chrono::duration<double>(now_.time_since_epoch()).count(); }

 private:
  Time now_{};
};

// Ten frames a second; the 6th comes 10 s late.
class TimedSource : public CountingSource {
 public:
  using CountingSource::CountingSource;
  std::function<void()> while_reading;  ///< called once
  void hide_count() { info_.frame_count.reset(); }
  ReadResult read(Frame& frame, milliseconds timeout) override {
    if (const auto call = std::exchange(while_reading, nullptr)) call();
    const ReadResult result = CountingSource::read(frame, timeout);
    frame.timestamp_us = frame.index * 100'000 + (frame.index > 5 ? 10'000'000 : 0);
    return result;
  }
};

class PacedSourceTest : public ::testing::Test {
 protected:
  void open(std::int64_t frames, PlayRange range = {}, std::set<std::int64_t> rejected = {}) {
    auto recording = std::make_unique<TimedSource>(frames, std::move(rejected));
    recording_ = recording.get();
    source_ = std::make_unique<PacedSource>(std::move(recording), playback_, range, clock_);
  }

  // The index of the next frame; -1 = none came.
  std::int64_t next(milliseconds timeout = milliseconds(60'000)) {
    return source_->read(frame_, timeout).status == ReadStatus::frame ? frame_.index : -1;
  }
  std::vector<std::int64_t> next(int count) {
    std::vector<std::int64_t> indices;
    for (int i = 0; i < count; ++i) indices.push_back(next());
    return indices;
  }

  using Indices = std::vector<std::int64_t>;
  const std::shared_ptr<FakeClock> clock_ = std::make_shared<FakeClock>();
  const std::shared_ptr<PlaybackControls> playback_ = std::make_shared<PlaybackControls>();
  std::unique_ptr<PacedSource> source_;
  TimedSource* recording_ = nullptr;  // the recording that it plays
  Frame frame_;
};

TEST_F(PacedSourceTest, FramesComeWhenTheirTimestampsAreDue) {
  open(10);
  EXPECT_EQ(next(), 0);
  EXPECT_DOUBLE_EQ(clock_->seconds(), 0);
  EXPECT_EQ(next(), 1);
  EXPECT_NEAR(clock_->seconds(), 0.1, 1e-6);
  EXPECT_EQ(next(4), (Indices{2, 3, 4, 5}));
  EXPECT_NEAR(clock_->seconds(), 0.5, 1e-6);
  EXPECT_EQ(next(), 6);
  EXPECT_NEAR(clock_->seconds(), 2.5, 1e-6) << "a gap lasts 2 s at most";
}

TEST_F(PacedSourceTest, OnlyThePartBetweenTheBoundsIsPlayed) {
  open(10);
  EXPECT_EQ(next(2), (Indices{0, 1}));
  playback_->set_in(3);
  playback_->set_out(5);
  EXPECT_EQ(next(8), (Indices{2, 3, 4, 5, 3, 4, 5, 3})) << "and looped";
  playback_->set_loop(false);
  EXPECT_EQ(next(3), (Indices{4, 5, -1}));
  EXPECT_TRUE(playback_->state().at_end);
  playback_->play();
  EXPECT_EQ(next(2), (Indices{3, 4}));
  playback_->step(4);
  EXPECT_EQ(next(), 8) << "a step may leave the part";
  playback_->play();
  EXPECT_EQ(next(2), (Indices{9, -1}));
}

TEST_F(PacedSourceTest, ABoundAtTheFrameOnScreenHoldsAtOnce) {
  open(10);
  EXPECT_EQ(next(5), (Indices{0, 1, 2, 3, 4}));
  EXPECT_EQ(next(milliseconds(1)), -1) << "the next one has been read ahead";
  playback_->set_out(4);
  EXPECT_EQ(next(2), (Indices{0, 1}));
  playback_->set_in(7);
  EXPECT_FALSE(playback_->state().out) << "it was before the new start";
  playback_->set_out(6);
  EXPECT_FALSE(playback_->state().in);
}

TEST_F(PacedSourceTest, APartWithoutUsableFramesPauses) {
  open(10, {}, {4, 5});
  playback_->set_in(4);
  playback_->set_out(5);
  playback_->seek(4);
  for (int i = 0; i < 6 && !playback_->state().paused; ++i)
    EXPECT_NE(source_->read(frame_, milliseconds(60'000)).status, ReadStatus::end);
}

TEST_F(PacedSourceTest, TheLastFrameIsFoundWhereTheirNumberIsNotKnown) {
  auto recording = std::make_unique<TimedSource>(10);
  recording->hide_count();
  source_ = std::make_unique<PacedSource>(std::move(recording), playback_, PlayRange{}, clock_);
  EXPECT_EQ(next(), 0);
  playback_->pause();
  playback_->seek(std::int64_t{1} << 40);
  EXPECT_EQ(next(), 9);
  EXPECT_EQ(next(), -1) << "it is paused there";
  playback_->seek(3);
  EXPECT_EQ(next(), 3);
}

TEST_F(PacedSourceTest, SpeedScalesTimeAndAtFullSpeedOnlyTheConsumerIsWaitedFor) {
  open(6);
  playback_->set_speed(0.1);
  next(2);
  EXPECT_NEAR(clock_->seconds(), 1, 1e-6);
  playback_->set_speed(8);
  next();
  const double before = clock_->seconds();
  next();
  EXPECT_NEAR(clock_->seconds() - before, 0.0125, 1e-6);

  playback_->set_speed(0);
  playback_->taken();
  EXPECT_EQ(next(), 4);
  EXPECT_EQ(next(milliseconds(1000)), -1) << "the consumer has not begun with the last frame";
  playback_->taken();
  EXPECT_EQ(next(), 5);
}

TEST_F(PacedSourceTest, ReadWaitsNoLongerThanItsTimeout) {
  open(3);
  next();
  EXPECT_EQ(next(milliseconds(30)), -1);
  EXPECT_NEAR(clock_->seconds(), 0.03, 1e-6);
  EXPECT_EQ(next(), 1);
  EXPECT_NEAR(clock_->seconds(), 0.1, 1e-6);
}

TEST_F(PacedSourceTest, WhilePausedItGivesOnlyRequestedFrames) {
  open(10);
  next(3);
  playback_->pause();
  EXPECT_EQ(next(), -1);
  playback_->step(1);
  EXPECT_EQ(next(), 3);
  playback_->step(-1);
  EXPECT_EQ(next(), 2);
  playback_->step(-1);
  playback_->step(-1);
  EXPECT_EQ(next(), 0) << "two steps before the read";
  playback_->step(-1);
  EXPECT_EQ(next(), 0) << "there is no frame before the first";
  playback_->seek(7);
  EXPECT_EQ(next(), 7);
  EXPECT_EQ(next(), -1);
  playback_->play();
  EXPECT_EQ(next(2), (Indices{8, 9}));
}

TEST_F(PacedSourceTest, AStepWhileAnotherIsReadStartsThere) {
  open(10);
  next(6);
  playback_->step(-1);
  recording_->while_reading = [&] { playback_->step(-1); };
  EXPECT_EQ(next(), 3);
  playback_->step(1);
  EXPECT_EQ(next(), 4);
}

TEST_F(PacedSourceTest, ShowsTheFrameAgainAsItWas) {
  open(10);
  next(3);
  playback_->pause();
  frame_.depth_mm.setTo(0);  // as the consumer may do
  playback_->show_again();
  EXPECT_EQ(next(), 2);
  EXPECT_EQ(frame_.depth_mm(0, 0), 2);
  EXPECT_EQ(next(), -1) << "once";

  playback_->play();
  next();
  const double before = clock_->seconds();
  playback_->show_again();
  EXPECT_EQ(next(), 3);
  EXPECT_EQ(next(), 4);
  EXPECT_NEAR(clock_->seconds() - before, 0.1, 1e-6) << "playback keeps its time";
}

TEST_F(PacedSourceTest, LoopsOrPausesAtTheEnd) {
  open(3);
  EXPECT_EQ(next(7), (Indices{0, 1, 2, 0, 1, 2, 0}));
  playback_->set_loop(false);
  EXPECT_EQ(next(4), (Indices{1, 2, -1, -1}));
  EXPECT_TRUE(playback_->state().paused);
  EXPECT_TRUE(playback_->state().at_end);
  playback_->play();
  EXPECT_EQ(next(2), (Indices{0, 1})) << "from the start again";
  EXPECT_FALSE(playback_->state().at_end);
}

TEST_F(PacedSourceTest, SeeksWhilePlayingAndContinuesThere) {
  open(10);
  next(2);
  playback_->seek(8);
  const double before = clock_->seconds();
  EXPECT_EQ(next(), 8);
  EXPECT_DOUBLE_EQ(clock_->seconds(), before) << "at once";
  EXPECT_EQ(next(), 9);
  playback_->seek(1000);
  EXPECT_EQ(next(), 9) << "the last";
}

TEST_F(PacedSourceTest, PlaysOnlyItsRange) {
  open(20, {4, 3, 3});
  EXPECT_EQ(next(5), (Indices{4, 7, 10, 4, 7}));
  playback_->seek(9);
  EXPECT_EQ(next(), 7) << "the frame of the range before it";
  playback_->pause();
  playback_->seek(0);
  EXPECT_EQ(next(), 4);
}

TEST_F(PacedSourceTest, AStepSkipsFramesThatCannotBeUsed) {
  open(6, {}, {2, 3});
  playback_->pause();
  EXPECT_EQ(next(), 0);
  playback_->step(1);
  EXPECT_EQ(next(), 1);
  playback_->step(1);
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::rejected);
  EXPECT_EQ(frame_.index, 2);
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::rejected);
  EXPECT_EQ(next(), 4);
  playback_->step(-1);
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::rejected);
  EXPECT_EQ(frame_.index, 3);
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::rejected);
  EXPECT_EQ(next(), 1);
}

TEST_F(PacedSourceTest, EndsOnlyIfNoFrameCanBeUsed) {
  open(2, {}, {0, 1});
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::rejected);
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::rejected);
  EXPECT_EQ(source_->read(frame_, milliseconds(10)).status, ReadStatus::end);
}

TEST_F(PacedSourceTest, TheTapGetsEachNewFrameOnce) {
  Indices seen;
  playback_->set_tap([&](const Frame& frame) { seen.push_back(frame.index); });
  open(4);
  next(2);
  playback_->show_again();
  next(2);
  playback_->set_tap({});
  next();
  EXPECT_EQ(seen, (Indices{0, 1, 2}));
}

TEST_F(PacedSourceTest, TheControlsWakeAWaitingReader) {
  source_ = std::make_unique<PacedSource>(std::make_unique<TimedSource>(10), playback_);
  playback_->pause();
  EXPECT_EQ(next(), 0);
  std::jthread hand([this] { playback_->seek(6); });
  EXPECT_EQ(next(), 6);
  std::jthread other([this] { source_->interrupt(); });
  EXPECT_EQ(next(), -1);
}

TEST_F(PacedSourceTest, JumpsAreCountedStepsAndDroppedFramesAreNot) {
  open(10);
  next(3);
  EXPECT_EQ(playback_->last_jump().count, 0);
  playback_->pause();
  playback_->step(1);
  EXPECT_EQ(next(), 3);
  EXPECT_EQ(playback_->last_jump().count, 0) << "the next frame";
  playback_->seek(7);
  EXPECT_EQ(playback_->last_jump().count, 0) << "only when the frame comes";
  EXPECT_EQ(next(), 7);
  EXPECT_EQ(playback_->last_jump().count, 1);
  EXPECT_EQ(playback_->last_jump().index, 7);
  playback_->step(-1);
  EXPECT_EQ(next(), 6);
  EXPECT_EQ(playback_->last_jump().count, 2);
  playback_->play();
  EXPECT_EQ(next(5), (Indices{7, 8, 9, 0, 1}));
  EXPECT_EQ(playback_->last_jump().count, 3) << "the loop";
  EXPECT_EQ(playback_->last_jump().index, 0);
}

}  // namespace
}  // namespace saccade
