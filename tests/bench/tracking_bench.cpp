// Attention over time beside the operator: the same frames with and without it, alternating in one run, so
// that other load on the machine meets both. Counters are medians of wall time per frame, milliseconds.

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "attention/proto.hpp"
#include "frames.hpp"
#include "models/model.hpp"
#include "register.hpp"
#include "settings/settings.hpp"
#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One model whose frames are attended to one by one or over time.
class Subject {
 public:
  explicit Subject(int workers) : pool_(workers), model_(make_model(Settings{}, pool_)) {}

  double alone(const Frame& frame) {
    const auto start = Clock::now();
    model_->compute(frame, {}, maps_, times_);
    selector_.select(maps_.master, frame.depth_mm, frame.intrinsics, attention_);
    return ms_since(start);
  }

  double tracked(const Frame& frame) {
    const auto start = Clock::now();
    follower_.start(frame);
    model_->compute(frame, {}, maps_, times_);
    follower_.wait();
    const auto attends = Clock::now();
    tracker_.attend(frame, maps_.master, follower_.surfaces(), follower_.step(), attention_);
    attend_ms_.push_back(ms_since(attends));
    return ms_since(start);
  }

  double attend_ms() const { return median(attend_ms_); }

 private:
  static constexpr int kPoints = 10;

  WorkerPool pool_;
  std::unique_ptr<SaliencyModel> model_;
  SaliencyMaps maps_;
  StageTimes times_;
  Attention attention_;
  ProtoSelector selector_{kPoints};
  FrameFollower follower_;
  AttentionTracker tracker_{kPoints, 0, {}};
  std::vector<double> attend_ms_;
};

// A second of a camera that goes around a scene, with a Kinect's noise; forwards and backwards, so that the
// camera never jumps. Times go on.
void run(benchmark::State& state, const std::string& scene, int workers) {
  cv::setNumThreads(1);
  auto frames = read_frames("synthetic:" + scene + "?seed=21&noise=kinect&camera=orbit&frames=30");
  Subject subject(workers);
  std::vector<double> alone, tracked;
  std::int64_t number = 0;
  const auto last = static_cast<std::int64_t>(frames.size()) - 1;
  for (auto _ : state) {
    const std::int64_t phase = number % (2 * last);
    Frame& frame = frames[static_cast<std::size_t>(std::min(phase, 2 * last - phase))];
    frame.index = number;
    frame.timestamp_us = number++ * 33'333;
    alone.push_back(subject.alone(frame));
    tracked.push_back(subject.tracked(frame));
  }
  state.counters["alone_ms"] = median(alone);
  state.counters["tracked_ms"] = median(tracked);
  state.counters["more_ms"] = median(tracked) - median(alone);
  state.counters["attend_ms"] = subject.attend_ms();
}

}  // namespace

void register_benchmarks() {
  for (const std::string scene : {"table", "room"})
    for (const int workers : {1, 2})
      benchmark::RegisterBenchmark((scene + "640x480/threads:" + std::to_string(workers)).c_str(),
                                   [=](benchmark::State& state) { run(state, scene, workers); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->Iterations(120);
}

}  // namespace saccade
