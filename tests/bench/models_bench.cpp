// What the models of the image cost beside the operator: every model on the same frame in turn, so that other
// load on the machine meets all of them. Counters: for each model the smallest time of the rounds,
// milliseconds, and that of `combined` in units of `symmetry3d`. On one thread it is processor time, on
// several wall time.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>

#include "models/model.hpp"
#include "processor_time.hpp"
#include "settings/settings.hpp"
#include "sources/synthetic_source.hpp"

namespace saccade {
namespace {

constexpr int kRounds = 40;

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// 640x480 with colour and a Kinect's noise.
Frame synthetic_table() {
  SyntheticSource source("synthetic:table?seed=1&noise=kinect&missing=0.2&frames=1");
  Frame frame;
  if (source.read(frame, std::chrono::milliseconds(0)).status != ReadStatus::frame)
    throw std::logic_error("the synthetic table has no frame");
  return frame;
}

/// A frame of a kitchen; without depth if it is not there.
Frame kitchen() {
  const std::filesystem::path folder = std::filesystem::path(SACCADE_SHARED_DIR) / "data/kitchen_sequence";
  Frame frame;
  if (!std::filesystem::exists(folder / "0000_depth.png")) return frame;
  cv::imread((folder / "0000_depth.png").string(), cv::IMREAD_UNCHANGED).convertTo(frame.depth_mm, CV_32F);
  frame.colour = cv::imread((folder / "0000_rgb.jpg").string());
  frame.intrinsics = Intrinsics::guess_for(frame.depth_mm.size());
  return frame;
}

void run(benchmark::State& state, const Frame& frame, int workers) {
  WorkerPool pool(workers);
  std::map<std::string, std::unique_ptr<SaliencyModel>> models;
  std::map<std::string, double> smallest;
  for (const std::string name : {"symmetry3d", "itti", "symmetry2d", "combined"}) {
    Settings settings;
    settings.model = name;
    models[name] = make_model(settings, pool);
    smallest[name] = std::numeric_limits<double>::max();
  }
  SaliencyMaps maps;
  StageTimes times;
  const auto now = [&] { return workers == 1 ? thread_processor_ms() : wall_ms(); };
  for (auto _ : state)
    for (int round = 0; round < kRounds; ++round)
      for (const auto& [name, model] : models) {
        const double start = now();
        model->compute(frame, {}, maps, times);
        smallest[name] = std::min(smallest[name], now() - start);
      }
  for (const auto& [name, time] : smallest) state.counters[name + "_ms"] = time;
  state.counters["ratio"] = smallest["combined"] / smallest["symmetry3d"];
}

void register_all() {
  for (const auto& [name, frame] : {std::pair{"table", synthetic_table()}, std::pair{"kitchen", kitchen()}})
    if (!frame.depth_mm.empty())
      for (const int workers : {1, 2})
        benchmark::RegisterBenchmark(
            (std::string(name) + "640x480/threads:" + std::to_string(workers)).c_str(),
            [=](benchmark::State& state) { run(state, frame, workers); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
}

[[maybe_unused]] const bool registered = (register_all(), true);

}  // namespace
}  // namespace saccade
