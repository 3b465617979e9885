// How a frame divides among more workers than this machine has processors. The worker pool of this program is
// one of its own, with the interface of core/worker_pool.hpp: it runs the chunks of every job one after the
// other and keeps their times. From these, the time of the frame on W workers is that of the serial rest
// plus, for each job, that of its chunks when each goes to the worker that is free first.
// The time to wake threads, and what they take from each other in caches and memory, is not in it.
//
// Counters: the processor time of a frame on one worker, milliseconds; the share that is serial, percent, and
// its milliseconds by stage; how many times faster the frame is on 2, 4, 8 and 16 workers.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "attention/proto.hpp"
#include "core/worker_pool.hpp"
#include "frames.hpp"
#include "models/model.hpp"
#include "processor_time.hpp"
#include "register.hpp"
#include "settings/settings.hpp"

namespace saccade {
namespace {

// A job of the pool, and the serial work between the one before and this one.
struct Job {
  double before_ms = 0;
  std::vector<double> chunks_ms;
  Stage stage = Stage::count;  // the stage that it belongs to
};

// The frame that is being computed. A stage's time is added when it ends, so a job belongs to the first stage
// that ends after it, and so does the serial work after the last job of a stage.
class FrameRecord {
 public:
  explicit FrameRecord(const StageTimes& times)
      : times_(times), before_(times), last_ms_(thread_processor_ms()) {}

  void begin_job() {
    close_stage();
    jobs_.push_back({thread_processor_ms() - last_ms_, {}});
    last_ms_ += jobs_.back().before_ms;
  }
  void end_chunk() {
    const double now = thread_processor_ms();
    jobs_.back().chunks_ms.push_back(now - last_ms_);
    last_ms_ = now;
  }
  // What comes after the last job is one without chunks.
  std::vector<Job> finish() {
    begin_job();
    close_stage();
    for (Job& job : jobs_)
      if (job.stage == Stage::count) job.stage = Stage::attention;
    return std::move(jobs_);
  }

 private:
  void close_stage() {
    for (std::size_t s = 0; s < kStageNames.size(); ++s) {
      const auto stage = static_cast<Stage>(s);
      if (times_[stage] == before_[stage]) continue;
      for (Job& job : jobs_)
        if (job.stage == Stage::count) job.stage = stage;
    }
    before_ = times_;
  }

  const StageTimes& times_;
  StageTimes before_;
  double last_ms_;
  std::vector<Job> jobs_;
};

FrameRecord* current_frame = nullptr;  // set while a frame is computed

}  // namespace

WorkerPool::WorkerPool(int workers) {
  if (workers != 1) throw std::invalid_argument("this pool has one worker");
}

WorkerPool::~WorkerPool() = default;

void WorkerPool::for_each(int chunks, const std::function<void(int, int)>& job) {
  if (current_frame) current_frame->begin_job();
  for (int chunk = 0; chunk < chunks; ++chunk) {
    job(chunk, 0);
    if (current_frame) current_frame->end_chunk();
  }
}

int processor_count() { return 1; }

namespace {

// Of two records of the same frame the smaller times: what each part takes when nothing disturbs it.
void keep_smaller(std::vector<Job>& kept, const std::vector<Job>& other) {
  if (kept.size() != other.size()) throw std::logic_error("the same frame has other jobs");
  for (std::size_t j = 0; j < kept.size(); ++j) {
    kept[j].before_ms = std::min(kept[j].before_ms, other[j].before_ms);
    for (std::size_t c = 0; c < kept[j].chunks_ms.size(); ++c)
      kept[j].chunks_ms[c] = std::min(kept[j].chunks_ms[c], other[j].chunks_ms.at(c));
  }
}

// Chunks begin in order, each on the worker that is free first.
double time_on(std::size_t workers, const std::vector<double>& chunks_ms) {
  std::vector<double> free_at(workers, 0.0);
  for (const double chunk : chunks_ms) *std::min_element(free_at.begin(), free_at.end()) += chunk;
  return *std::max_element(free_at.begin(), free_at.end());
}

double time_on(std::size_t workers, const std::vector<Job>& jobs) {
  double sum = 0;
  for (const Job& job : jobs) sum += job.before_ms + time_on(workers, job.chunks_ms);
  return sum;
}

void run(benchmark::State& state, const Frame& frame, const std::string& model_name) {
  constexpr int kRounds = 30;
  WorkerPool pool(1);
  Settings settings;
  settings.model = model_name;
  const std::unique_ptr<SaliencyModel> model = make_model(settings, pool);
  ProtoSelector selector(10);
  SaliencyMaps maps;
  Attention attention;
  std::vector<Job> jobs;
  for (auto _ : state)
    for (int round = 0; round < kRounds + 1; ++round) {
      StageTimes times;
      FrameRecord record(times);
      current_frame = &record;
      model->compute(frame, {}, maps, times);
      selector.select(maps.master, frame.depth_mm, frame.intrinsics, attention);
      current_frame = nullptr;
      if (round == 0) continue;  // it allocates
      if (round == 1)
        jobs = record.finish();
      else
        keep_smaller(jobs, record.finish());
    }
  const double alone = time_on(1, jobs);
  double serial = 0;
  for (const Job& job : jobs) {
    serial += job.before_ms;
    state.counters["serial_" + std::string(kStageNames[static_cast<std::size_t>(job.stage)])] +=
        job.before_ms;
  }
  state.counters["ms"] = alone;
  state.counters["serial_percent"] = 100 * serial / alone;
  for (const std::size_t workers : {2, 4, 8, 16})
    state.counters["x" + std::to_string(workers)] = alone / time_on(workers, jobs);
}

}  // namespace

void register_benchmarks() {
  for (const auto& [name, uri] : {std::pair{std::string("table"), kBenchTable},
                                  {"room", "synthetic:room?seed=21&noise=kinect&frames=1"},
                                  {"kitchen", shared_data("kitchen_sequence")}})
    for (const Frame& frame : read_frames(uri, 1))
      for (const std::string model : {"symmetry3d", "combined"})
        benchmark::RegisterBenchmark((name + "/" + model).c_str(),
                                     [=](benchmark::State& state) { run(state, frame, model); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
}

}  // namespace saccade
