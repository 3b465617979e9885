#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "attention/attention.hpp"
#include "models/model.hpp"
#include "pipeline/processor.hpp"
#include "ui/view_result.hpp"

namespace saccade {

/// What is to be computed of each frame.
struct Wishes {
  Settings a;                 ///< its intrinsics, if there are any, take the place of the frame's
  std::optional<Settings> b;  ///< a second computation of the same frame
  SaliencyWants wants;        ///< by-products of both, where the model has them
};

/// A processor whose settings may change between frames: each frame is computed with the newest wishes, and
/// what a change does not concern is kept. A frame that cannot be computed is no end: its result says why.
/// Thread safety: process() on one thread, the others on any.
class TunableProcessor final : public FrameProcessor {
 public:
  struct Hooks {
    std::function<void()> begun;                               ///< process() has taken up a frame
    std::function<void(std::shared_ptr<ViewResult>)> publish;  ///< process() has computed it
  };

  TunableProcessor(Wishes wishes, std::int64_t generation, Hooks hooks);
  ~TunableProcessor() override;

  /// For the frames that process() takes up from now on.
  void set_wishes(Wishes wishes, std::int64_t generation);

  /// What is computed goes to Hooks::publish; of `result` only the times are filled.
  void process(Result& result) override;

 private:
  class Engine;
  class Pool;

  Hooks hooks_;
  std::mutex mutex_;
  Wishes wishes_;                // guarded by mutex_
  std::int64_t generation_ = 0;  // guarded by mutex_
  // process()'s thread only:
  std::unique_ptr<WorkerPool> workers_;
  std::unique_ptr<Engine> a_, b_;
  std::shared_ptr<Pool> results_;
};

}  // namespace saccade
