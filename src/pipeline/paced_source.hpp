#pragma once

#include <memory>
#include <optional>

#include "core/frame_source.hpp"
#include "pipeline/playback_controls.hpp"

namespace saccade {

/// Plays a recording like a live source: each frame comes when its timestamp is due, and PlaybackControls
/// pauses, steps, seeks, loops and changes the speed. Gaps of more than two seconds between timestamps are
/// shortened to two seconds. At the end, without a loop, it pauses: read() returns `end` only if the
/// recording has no usable frame at all. The frames of a live source are passed on as they come; it can be
/// paused, and its last frame shown again.
///
/// read() waits at most for its timeout. It returns `rejected` for frames that cannot be used; a step then
/// continues in its direction.
class PacedSource final : public FrameSource {
 public:
  /// Starts with the first frame of the range, which is ignored for live sources. Without a `clock`, uses the
  /// system's.
  PacedSource(std::unique_ptr<FrameSource> source, std::shared_ptr<PlaybackControls> playback,
              PlayRange range = {}, std::shared_ptr<PlayClock> clock = nullptr);

  const SourceInfo& info() const override { return source_->info(); }
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override;
  /// As PlaybackControls::seek(). Throws std::logic_error for a live source.
  void seek(std::int64_t index) override;
  SourceState state() const override { return source_->state(); }
  void interrupt() noexcept override;

 private:
  using Lock = std::unique_lock<std::mutex>;
  using Time = PlayClock::Time;

  ReadResult read_live(Lock& lock, Frame& frame, Time deadline);
  ReadResult read_recorded(Lock& lock, Frame& frame, Time deadline);
  void go_to_wanted();
  void seek_unknown_end();
  ReadResult fetch(Lock& lock);
  std::int64_t nearest(std::int64_t index) const;
  bool leaves_part() const;
  ReadResult turn_at_end();
  bool is_due(Time& when);
  ReadResult give(Lock& lock, Frame& frame);
  void copy_last(Frame& frame);

  std::unique_ptr<FrameSource> source_;
  std::shared_ptr<PlaybackControls> playback_;
  PlayRange range_;
  std::shared_ptr<PlayClock> clock_;
  std::int64_t end_ = 0;     // one past the last index of the range
  std::int64_t next_ = 0;    // index to read next
  bool at_next_ = true;      // the source is positioned there
  bool has_ahead_ = false;   // ahead_ has been read and waits until it is due
  bool has_last_ = false;    // last_ is the frame given last
  bool going_ = true;        // the next frame is given at once, whatever its time, and in a pause too
  bool to_end_ = false;      // reads on, without giving frames, to a last frame whose index is not known yet
  bool any_usable_ = false;  // since the start of this turn of the loop
  bool jumped_ = false;      // since the frame given last
  Frame ahead_, last_;
  Time last_due_{}, due_{};   // of the frame given last, of the one read ahead
  bool interrupted_ = false;  // guarded by the mutex of playback_, as are all members above
};

}  // namespace saccade
