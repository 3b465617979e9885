// What the models of the image cost beside the operator: every model on the same frame in turn, so that other
// load on the machine meets all of them. Counters: for each model the smallest time of the rounds,
// milliseconds, and that of `combined` in units of `symmetry3d`. On one thread it is processor time, on
// several wall time.

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <string>

#include <benchmark/benchmark.h>

#include "frames.hpp"
#include "models/model.hpp"
#include "processor_time.hpp"
#include "register.hpp"
#include "settings/settings.hpp"

namespace saccade {
namespace {

constexpr int kRounds = 40;

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
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

}  // namespace

void register_benchmarks() {
  for (const auto& [name, uri] :
       {std::pair{"table", kBenchTable}, std::pair{"kitchen", shared_data("kitchen_sequence")}})
    for (const Frame& frame : read_frames(uri, 1))
      for (const int workers : {1, 2})
        benchmark::RegisterBenchmark(
            (std::string(name) + "640x480/threads:" + std::to_string(workers)).c_str(),
            [=](benchmark::State& state) { run(state, frame, workers); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
}

}  // namespace saccade
