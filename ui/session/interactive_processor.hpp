#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "pipeline/processor.hpp"
#include "ui/session/model_runner.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// What is to be computed of each frame.
struct ComputeRequest {
  Settings a;                 ///< its intrinsics, if there are any, take the place of the frame's
  std::optional<Settings> b;  ///< a second computation of the same frame
  RequestedOutputs outputs;   ///< by-products of both, where the model has them
};

/// A processor whose settings may change between frames: each frame is computed with the newest request, and
/// what a change does not concern is kept. Where new request take long, a draft comes first (draft_of()), and
/// what is computed is given up as soon as it is not wished for any more. A frame that cannot be computed is
/// no end: its result says why.
/// Thread safety: process() on one thread, the others on any.
class InteractiveProcessor final : public FrameProcessor {
 public:
  struct Hooks {
    std::function<void()> begun;                               ///< process() has taken up a frame
    std::function<void(std::shared_ptr<ViewResult>)> publish;  ///< a draft of it, or all of it
    std::function<void()> ended;                               ///< process() is through with it
  };

  InteractiveProcessor(ComputeRequest request, std::int64_t generation, Hooks hooks);
  ~InteractiveProcessor() override;

  /// For the frames that process() takes up from now on, and for the one that it is at, if that takes long.
  void set_compute_request(ComputeRequest request, std::int64_t generation);

  /// process() ends soon, and from now on at once.
  void stop();

  /// What is computed goes to Hooks::publish, unless it is the same as the last time: the same frame, and
  /// nothing else was wished for. Of `result` only the times are filled.
  void process(Result& result) override;

 private:
  class Pool;
  enum class Part { draft, whole };

  void start(const Settings& settings);
  bool take_request(const Frame& frame, ComputeRequest& request, std::int64_t& generation);
  bool begin_slow(std::int64_t generation);
  void end_slow();
  std::shared_ptr<ViewResult> compute(const Result& result, const ComputeRequest& request,
                                      std::int64_t generation, Part part);

  Hooks hooks_;
  std::mutex mutex_;
  ComputeRequest request_;               // guarded by mutex_
  std::int64_t generation_ = 0;          // guarded by mutex_
  bool slow_ = false, stopped_ = false;  // guarded by mutex_; slow_: new request end what is computed
  std::unique_ptr<WorkerPool> workers_;  // made by process() under mutex_, interrupted and resumed under it
  // process()'s thread only:
  std::unique_ptr<ModelRunner> a_, b_, draft_a_, draft_b_;
  std::shared_ptr<Pool> results_;
  std::shared_ptr<const ViewResult> last_;   // the whole one that was published last
  std::shared_ptr<const ViewResult> known_;  // the last one: what it has need not be computed again
};

}  // namespace saccade
