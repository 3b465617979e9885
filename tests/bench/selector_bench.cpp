// The selector `proto` and its parts on one thread, frame by frame: what counts beside a sensor is the worst
// frame. Counters: processor time of a frame, milliseconds, the smallest of the repetitions of that frame;
// the median over the frames of a set, and the largest with the parts of that frame.

#include <algorithm>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "attention/border_ownership.hpp"
#include "attention/proto.hpp"
#include "frames.hpp"
#include "models/model.hpp"
#include "processor_time.hpp"
#include "register.hpp"
#include "settings/settings.hpp"

namespace saccade {
namespace {

constexpr int kPoints = 10;

struct Times {
  double all = 0, grid = 0, segments = 0, borders = 0;
};

Times measure(const Frame& frame, const cv::Mat1f& map, ProtoSelector& selector) {
  constexpr int kRepetitions = 15;
  Attention attention;
  SurfaceGrid grid;
  SurfaceSegments segments;
  BorderOwnership borders;
  Times times;
  times.all = smallest_processor_ms(
      kRepetitions, [&] { selector.select(map, frame.depth_mm, frame.intrinsics, attention); });
  times.grid = smallest_processor_ms(kRepetitions, [&] { grid.build(frame.depth_mm, frame.intrinsics); });
  times.segments = smallest_processor_ms(kRepetitions, [&] { segments.grow(grid); });
  times.borders = smallest_processor_ms(kRepetitions, [&] { borders.measure(grid, segments); });
  return times;
}

void run(benchmark::State& state, const std::vector<Frame>& frames) {
  WorkerPool pool(1);
  const std::unique_ptr<SaliencyModel> model = make_model(Settings{}, pool);
  ProtoSelector selector(kPoints);
  SaliencyMaps maps;
  StageTimes stages;
  std::vector<Times> times;
  for (auto _ : state) {
    times.clear();
    for (const Frame& frame : frames) {
      model->compute(frame, {}, maps, stages);
      times.push_back(measure(frame, maps.master, selector));
    }
  }
  const auto less = [](const Times& a, const Times& b) { return a.all < b.all; };
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::sort(times.begin(), times.end(), less);
  const Times& worst = times.back();
  state.counters["median_ms"] = middle->all;
  state.counters["worst_ms"] = worst.all;
  state.counters["worst_grid"] = worst.grid;
  state.counters["worst_segments"] = worst.segments;
  state.counters["worst_borders"] = worst.borders;
}

}  // namespace

void register_benchmarks() {
  const auto add = [](const std::string& name, const std::vector<Frame>& frames) {
    if (!frames.empty())
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { run(state, frames); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
  };
  for (const std::string scene : {"table", "room"})  // a camera that goes around it
    add("synthetic_" + scene,
        read_frames("synthetic:" + scene + "?seed=21&noise=kinect&camera=orbit&frames=20"));
  for (const std::string folder : {"osd_learn", "rooms_avd", "rooms_2d3ds_mod", "kitchen_sequence"})
    add(folder, read_frames(shared_data(folder)));
}

}  // namespace saccade
