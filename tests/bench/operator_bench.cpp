// The operator and its stages for several instruction sets, threads, k and image sizes, and the reference in
// the same run. Counters: milliseconds of each stage per frame, and the share of valid pixels.

#include <string>

#include <benchmark/benchmark.h>

#include "core/error.hpp"
#include "frames.hpp"
#include "register.hpp"
#include "saliency/reference.hpp"
#include "saliency/symmetry3d.hpp"

namespace saccade {
namespace {

cv::Mat1f table(cv::Size size) {
  return read_frames(kBenchTable + "&size=" + std::to_string(size.width) + "x" + std::to_string(size.height))
      .front()
      .depth_mm;
}

void run(benchmark::State& state, const cv::Mat1f& depth, const std::string& simd, int workers, int kernel) {
  Symmetry3dParams params;
  params.kernel = kernel;
  WorkerPool pool(workers);
  Symmetry3d op(params, pool, simd);
  SaliencyMaps maps;
  StageTimes warm_up, times;
  const Intrinsics camera = Intrinsics::guess_for(depth.size());
  op.compute(depth, camera, {}, maps, warm_up);
  for (auto _ : state) op.compute(depth, camera, {}, maps, times);
  const double frames = static_cast<double>(state.iterations());
  for (const Stage stage : {Stage::points, Stage::symmetry, Stage::master_map})
    state.counters[std::string(kStageNames[static_cast<std::size_t>(stage)]) + "_ms"] = times[stage] / frames;
  state.counters["valid"] = static_cast<double>(cv::countNonZero(depth)) / static_cast<double>(depth.total());
}

/// The reference, one thread.
void run_reference(benchmark::State& state, const cv::Mat1f& depth) {
  for (auto _ : state)
    benchmark::DoNotOptimize(reference::symmetry3d(depth, Intrinsics::guess_for(depth.size()), {}).master);
}

template <typename Function>
void add(const std::string& name, Function function) {
  benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMillisecond)->UseRealTime();
}

bool can_run(const std::string& simd) {
  try {
    WorkerPool pool(1);
    const Symmetry3d probe({}, pool, simd);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

void register_benchmarks() {
  const auto add_run = [](const std::string& image, const cv::Mat1f& depth, const std::string& simd,
                          int workers, int kernel) {
    add(image + "/" + simd + "/threads:" + std::to_string(workers) + "/k:" + std::to_string(kernel),
        [=](benchmark::State& state) { run(state, depth, simd, workers, kernel); });
  };
  const cv::Mat1f vga = table({640, 480});
  add("table640x480/reference/threads:1/k:15", [=](benchmark::State& state) { run_reference(state, vga); });
  for (const std::string simd : {"avx512", "avx2", "sse4", "neon", "scalar"}) {
    if (!can_run(simd)) continue;
    for (const int workers : {1, 2})
      for (const int kernel : {10, 15, 20, 30}) add_run("table640x480", vga, simd, workers, kernel);
  }
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(1280, 1024), cv::Size(1920, 1080)})
    for (const int workers : {1, 2})
      add_run("table" + std::to_string(size.width) + "x" + std::to_string(size.height), table(size), "auto",
              workers, 15);
  for (const std::string name :
       {"osd_full/0000_depth.png", "rooms_avd/0000_depth.png", "kitchen_sequence/0000_depth.png"})
    for (const Frame& frame : read_frames(shared_data(name), 1))
      for (const std::string simd : {"avx512", "avx2"})
        if (can_run(simd))
          for (const int workers : {1, 2}) add_run(name, frame.depth_mm, simd, workers, 15);
}

}  // namespace saccade
