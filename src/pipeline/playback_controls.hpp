#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "core/frame.hpp"

namespace saccade {

/// The clock of a player; tests replace it.
class PlayClock {
 public:
  using Time = std::chrono::steady_clock::time_point;
  virtual ~PlayClock() = default;
  virtual Time now() { return std::chrono::steady_clock::now(); }
  /// Waits until `until`, or until `changed` is signalled.
  virtual void wait(std::unique_lock<std::mutex>& lock, std::condition_variable& changed, Time until) {
    changed.wait_until(lock, until);
  }
};

/// The frames of a recording to play: start, start + every, ...; at most `limit` of them.
struct PlayRange {
  std::int64_t start = 0;
  std::int64_t every = 1;
  std::int64_t limit = 0;  ///< 0 = all
};

/// The state of a player.
struct PlaybackState {
  bool paused = false;
  bool loop = true;
  double speed = 1;            ///< relative to the recorded time; 0 = as fast as the frames can be computed
  std::int64_t position = -1;  ///< index of the frame given last; -1 = none yet
  bool at_end = false;         ///< paused because there is no further frame
  std::optional<std::int64_t> in, out;  ///< first and last index of the part that is played; none = all
};

/// The last jump of a player: a frame was given that does not follow the one before it, after a seek or at
/// the beginning of a loop.
struct PlayJump {
  std::int64_t count = 0;  ///< of all jumps so far
  std::int64_t index = 0;  ///< of the first frame after the last one
};

/// The controls of a player; a PacedSource follows them. They outlast the source and keep their state, except
/// for the position, when the next one is opened. Any thread may call any function.
class PlaybackControls {
 public:
  static constexpr double kSlowest = 0.1, kFastest = 8;

  void play();  ///< at the end, plays from the start of the part
  void pause();
  void toggle() { state().paused ? play() : pause(); }
  void set_loop(bool loop);
  /// kSlowest..kFastest, clamped, or 0 for as fast as possible.
  void set_speed(double speed);

  /// Bounds of the part of the recording that is played and looped, both included; none = as far as there are
  /// frames. A bound on the wrong side of the other one removes that one. Steps and seeks may leave the part;
  /// from behind it, playing goes on to the end of the recording.
  void set_in(std::optional<std::int64_t> index);
  void set_out(std::optional<std::int64_t> index);

  /// Pauses and moves by `frames`, forwards (> 0) or backwards (< 0).
  void step(std::int64_t frames);

  /// Makes the frame at `index` the next one, paused or not.
  void seek(std::int64_t index);

  /// Gives the last frame once more, to be computed with other settings. Playback is not affected.
  void show_again();

  /// Reports that the consumer has begun to compute the last frame. At the speed "as fast as possible" the
  /// next one is given then.
  void taken();

  /// A function to call with each new frame, on the capture thread; empty = none. It must not call any
  /// function of the controls.
  void set_tap(std::function<void(const Frame&)> tap);

  PlaybackState state() const;
  PlayJump last_jump() const;

 private:
  friend class PacedSource;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // All guarded by mutex_.
  PlaybackState state_;
  PlayJump jump_;
  std::optional<std::int64_t> wanted_;  // index requested by step() or seek()
  std::optional<std::int64_t>
      going_to_;          // the last wanted_ that the source has accepted, until it gives a frame
  std::int64_t way_ = 1;  // direction to continue in if that frame cannot be used
  bool again_ = false;
  bool taken_ = true;
  bool rebase_ = true;  // the next frame is due at once
  std::shared_ptr<std::function<void(const Frame&)>> tap_;
};

}  // namespace saccade
