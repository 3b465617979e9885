#pragma once

#include <memory>
#include <optional>

#include "core/frame_source.hpp"
#include "pipeline/playback_controls.hpp"

namespace saccade {

/// Plays a recording as if it were a live source: each frame comes when its timestamp is due, and
/// PlaybackControls's buttons pause it, step, seek, loop and change the speed. A hole in the timestamps of
/// more than two seconds is not waited for. At the end, without a loop, it pauses: read() never returns `end`
/// unless the recording has no frame at all that could be shown. Of a live source frames are passed on as
/// they come; it can be paused, and its last frame be shown again.
///
/// read() waits at most for its timeout. Frames that cannot be used are told as `rejected`, and a step goes
/// on in its direction.
class PacedSource final : public FrameSource {
 public:
  /// Starts with the first frame of the range, which is ignored for live sources. `clock` is the system's if
  /// null.
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
  ReadResult fetch(Lock& lock);
  ReadResult turn_at_end();
  bool is_due(Time& when);
  ReadResult give(Lock& lock, Frame& frame);
  void copy_last(Frame& frame);

  std::unique_ptr<FrameSource> source_;
  std::shared_ptr<PlaybackControls> playback_;
  PlayRange range_;
  std::shared_ptr<PlayClock> clock_;
  std::int64_t end_ = 0;     // behind the last index of the range
  std::int64_t next_ = 0;    // index that is read next
  bool at_next_ = true;      // the source stands there
  bool has_ahead_ = false;   // ahead_ is read and waits until it is due
  bool has_last_ = false;    // last_ is what was given last
  bool going_ = true;        // somebody waits for the next frame: neither pause nor time holds it up
  bool any_usable_ = false;  // since the last turn of the loop
  Frame ahead_, last_;
  Time last_due_{}, due_{};   // of the frame given last, of the one read ahead
  bool interrupted_ = false;  // guarded by the playback's mutex, as is the use of all above
};

}  // namespace saccade
