#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "pipeline/playback_controls.hpp"
#include "pipeline/processor.hpp"
#include "tracking/frame_follower.hpp"
#include "ui/session/compute_request.hpp"
#include "ui/session/model_runner.hpp"
#include "ui/session/sequence_memory.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// A processor whose settings may change between frames: each frame is computed with the newest request, and
/// results that a change does not affect are kept. The frames of a sequence share a memory (SequenceMemory),
/// which a frame that is computed several times does not advance. Where a new request takes long, a draft
/// comes first (draft_of()); a newer request ends the computation of an old one. A frame that cannot be
/// computed does not end the run: its result says why. Thread safety: process() on one thread, the others on
/// any.
class InteractiveProcessor final : public FrameProcessor {
 public:
  struct Hooks {
    std::function<void()> begun;                               ///< process() has begun with a frame
    std::function<void(std::shared_ptr<ViewResult>)> publish;  ///< a draft of it, or the whole result
    std::function<PlayJump()> last_jump{};                     ///< of the player; empty = it never jumps
  };

  /// sequence: the frames are those of one (SourceInfo::sequence).
  InteractiveProcessor(ComputeRequest request, std::int64_t generation, bool sequence, Hooks hooks);
  ~InteractiveProcessor() override;

  /// Holds for all later frames, and for the present one if that takes long. Results carry `generation`.
  void set_compute_request(ComputeRequest request, std::int64_t generation);

  /// Ends process() soon, and every later call at once.
  void stop();

  /// Publishes the results of the frame, unless frame and request are those of the last result. Fills only
  /// the times of `result`.
  void process(Result& result) override;

 private:
  class Pool;
  enum class Part { draft, whole };
  // A frame whose surfaces and camera motion are known, or are being computed.
  struct Followed {
    std::int64_t index, timestamp_us;
    cv::Size size;
    Intrinsics camera;
    Frame frame;               // shares its pixels; empty when it is no longer needed
    bool busy;                 // it is still being followed
    std::exception_ptr error;  // why it could not be
  };

  void start(const Settings& settings);
  bool take_request(const Frame& frame, ComputeRequest& request, std::int64_t& generation);
  bool begin_slow(std::int64_t generation);
  void end_slow();
  bool tracks(const Settings& settings) const;
  bool is_after_jump(const Frame& frame);
  void follow(const Frame& frame, const ComputeRequest& request);
  void finish_following() noexcept;
  void attend(SequenceMemory& memory, const SequenceMemory& other, Computed& computed);
  std::shared_ptr<ViewResult> compute(const Result& result, const ComputeRequest& request,
                                      std::int64_t generation, Part part);

  const bool sequence_;
  Hooks hooks_;
  std::mutex mutex_;
  ComputeRequest request_;               // guarded by mutex_
  std::int64_t generation_ = 0;          // guarded by mutex_
  bool slow_ = false, stopped_ = false;  // guarded by mutex_; slow_: a new request interrupts the computation
  std::unique_ptr<WorkerPool> workers_;  // made, interrupted and resumed under mutex_
  // process()'s thread only:
  std::unique_ptr<ModelRunner> a_, b_, draft_a_, draft_b_;
  std::optional<Followed> followed_;             // the last frame
  std::unique_ptr<FrameFollower> follower_;      // made with the first
  std::int64_t followed_count_ = 0, jumps_ = 0;  // jumps_: those before the last frame
  SequenceMemory a_memory_, b_memory_;
  std::shared_ptr<Pool> results_;
  std::shared_ptr<const ViewResult> last_;   // the last whole result
  std::shared_ptr<const ViewResult> known_;  // the last result, also a draft: its maps can be taken over
};

}  // namespace saccade
