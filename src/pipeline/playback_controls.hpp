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

/// What time it is and how to wait for it; tests have one of their own.
class PlayClock {
 public:
  using Time = std::chrono::steady_clock::time_point;
  virtual ~PlayClock() = default;
  virtual Time now() { return std::chrono::steady_clock::now(); }
  /// Waits until `until`, or until somebody signals `changed`.
  virtual void wait(std::unique_lock<std::mutex>& lock, std::condition_variable& changed, Time until) {
    changed.wait_until(lock, until);
  }
};

/// The frames of a recording that are played: start, start + every, ...; at most `limit` of them.
struct PlayRange {
  std::int64_t start = 0;
  std::int64_t every = 1;
  std::int64_t limit = 0;  ///< 0 = all
};

/// Where a player stands.
struct PlaybackState {
  bool paused = false;
  bool loop = true;
  double speed = 1;            ///< of the recorded time; 0 = as fast as the frames can be computed
  std::int64_t position = -1;  ///< index of the frame given last; -1 = none yet
  bool at_end = false;         ///< paused because there is no further frame
};

/// The buttons of a player. They belong to who pushes them; a PacedSource does what they say. They keep
/// their state when the next source is opened, except for the position. Any thread may call anything.
class PlaybackControls {
 public:
  static constexpr double kSlowest = 0.1, kFastest = 8;

  void play();  ///< from the start if it stands at the end
  void pause();
  void toggle() { state().paused ? play() : pause(); }
  void set_loop(bool loop);
  /// kSlowest..kFastest, clamped, or 0 for as fast as possible.
  void set_speed(double speed);

  /// Pauses and goes so many frames on (> 0) or back (< 0).
  void step(std::int64_t frames);

  /// Goes to a frame, which is given next, whether paused or not.
  void seek(std::int64_t index);

  /// Gives the frame that was given last once more, because it is to be computed in another way. What is
  /// played goes on as if nothing had happened.
  void show_again();

  /// The consumer has begun with the frame given last: when it is played as fast as possible the next may
  /// come.
  void taken();

  /// Is called with each new frame, on the thread that captures; empty = nobody. Must not call back.
  void set_tap(std::function<void(const Frame&)> tap);

  PlaybackState state() const;

 private:
  friend class PacedSource;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // All guarded by mutex_.
  PlaybackState state_;
  std::optional<std::int64_t> wanted_;    // frame to go to
  std::optional<std::int64_t> going_to_;  // the last of these that was taken up, until a frame is given
  std::int64_t way_ = 1;                  // where to look on if that frame cannot be used
  bool again_ = false;
  bool taken_ = true;
  bool rebase_ = true;  // the frame given next is due at once
  std::shared_ptr<std::function<void(const Frame&)>> tap_;
};

}  // namespace saccade
