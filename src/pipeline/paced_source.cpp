#include "pipeline/paced_source.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace saccade {
namespace {

using std::chrono::duration_cast;
using std::chrono::microseconds;

constexpr std::int64_t kLongestGap_us = 2'000'000;
constexpr std::int64_t kUnknown = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kFarthest = std::int64_t{1} << 39;  // no recording has so many frames
constexpr double kUsualRate_hz = 30;
constexpr std::chrono::milliseconds kLateness{100};  // a greater delay is not made up for

}  // namespace

PacedSource::PacedSource(std::unique_ptr<FrameSource> source, std::shared_ptr<PlaybackControls> playback,
                         PlayRange range, std::shared_ptr<PlayClock> clock)
    : source_(std::move(source)),
      playback_(std::move(playback)),
      range_(range),
      clock_(clock ? std::move(clock) : std::make_shared<PlayClock>()) {
  if (range_.start < 0 || range_.every < 1 || range_.limit < 0)
    throw std::invalid_argument("PacedSource: start >= 0, every >= 1 and limit >= 0 expected");
  end_ = info().frame_count.value_or(kUnknown);
  if (range_.limit > 0 && range_.limit <= (end_ - range_.start) / range_.every)
    end_ = range_.start + range_.limit * range_.every;
  next_ = range_.start;
  at_next_ = next_ == 0;
  const Lock lock(playback_->mutex_);
  playback_->state_.position = -1;
  playback_->state_.at_end = false;
  playback_->state_.in.reset();
  playback_->state_.out.reset();
  playback_->wanted_.reset();
  playback_->going_to_.reset();
  playback_->again_ = false;
  playback_->taken_ = playback_->rebase_ = true;
}

void PacedSource::seek(std::int64_t index) {
  if (info().live) throw std::logic_error("a live source cannot seek");
  playback_->seek(index);
}

void PacedSource::interrupt() noexcept {
  {
    const Lock lock(playback_->mutex_);
    interrupted_ = true;
  }
  playback_->changed_.notify_all();
  source_->interrupt();
}

ReadResult PacedSource::read(Frame& frame, std::chrono::milliseconds timeout) {
  const Time deadline = clock_->now() + timeout;
  Lock lock(playback_->mutex_);
  return info().live ? read_live(lock, frame, deadline) : read_recorded(lock, frame, deadline);
}

ReadResult PacedSource::read_live(Lock& lock, Frame& frame, Time deadline) {
  PlaybackControls& p = *playback_;
  p.wanted_.reset();  // a live source cannot seek
  while (!interrupted_) {
    if (std::exchange(p.again_, false) && has_last_) {
      copy_last(frame);
      return {ReadStatus::frame, ""};
    }
    const Time now = clock_->now();
    if (now >= deadline) break;
    if (p.state_.paused && has_last_) {
      clock_->wait(lock, p.changed_, deadline);
      continue;
    }
    lock.unlock();
    ReadResult result = source_->read(
        ahead_,
        std::max(duration_cast<std::chrono::milliseconds>(deadline - now), std::chrono::milliseconds(1)));
    lock.lock();
    return result.status == ReadStatus::frame ? give(lock, frame) : result;
  }
  return {ReadStatus::timeout, ""};
}

ReadResult PacedSource::read_recorded(Lock& lock, Frame& frame, Time deadline) {
  PlaybackControls& p = *playback_;
  while (!interrupted_) {
    if (p.wanted_) go_to_wanted();
    if (std::exchange(p.again_, false) && has_last_) {
      copy_last(frame);
      return {ReadStatus::frame, ""};
    }
    Time when = deadline;
    if (p.state_.paused && !going_) {
      // Only the controls end this.
    } else if (!has_ahead_ || leaves_part()) {
      ReadResult result = next_ < end_ && !leaves_part() ? fetch(lock) : turn_at_end();
      if (result.status == ReadStatus::frame) continue;
      if (result.status == ReadStatus::rejected) frame.index = ahead_.index;
      return result;
    } else if (is_due(when)) {
      return give(lock, frame);
    }
    if (clock_->now() >= deadline) break;
    clock_->wait(lock, p.changed_, std::min(when, deadline));
  }
  return {ReadStatus::timeout, ""};
}

// The index of the range that is nearest to this one, or before it.
std::int64_t PacedSource::nearest(std::int64_t index) const {
  const std::int64_t last = range_.start + (end_ - 1 - range_.start) / range_.every * range_.every;
  return range_.start + (std::clamp(index, range_.start, last) - range_.start) / range_.every * range_.every;
}

// Makes the requested frame the next one, due at once.
void PacedSource::go_to_wanted() {
  PlaybackControls& p = *playback_;
  to_end_ = end_ == kUnknown && *p.wanted_ >= kFarthest;
  if (to_end_) return seek_unknown_end();
  const std::int64_t index = nearest(*std::exchange(p.wanted_, std::nullopt));
  going_ = true;
  p.going_to_ = index;
  p.rebase_ = true;
  if (has_last_ && index != last_.index && index != last_.index + range_.every) jumped_ = true;
  if (has_ahead_ && ahead_.index == index) return;
  has_ahead_ = false;
  at_next_ = at_next_ && next_ == index;
  next_ = index;
}

// The end is found by reading up to it; the last frame is the wanted one then.
void PacedSource::seek_unknown_end() {
  PlaybackControls& p = *playback_;
  p.wanted_.reset();
  going_ = true;
  p.rebase_ = true;
  jumped_ = true;
  has_ahead_ = false;
}

// Reads the next frame of the range ahead, without the lock. Returns `frame` if it was read, or if the source
// ended early.
ReadResult PacedSource::fetch(Lock& lock) {
  lock.unlock();
  ReadResult result;
  if (!std::exchange(at_next_, range_.every == 1)) source_->seek(next_);
  result = source_->read(ahead_, std::chrono::milliseconds(0));
  lock.lock();
  switch (result.status) {
    case ReadStatus::frame:
      has_ahead_ = !to_end_;
      any_usable_ = true;
      next_ += range_.every;
      break;
    case ReadStatus::rejected:
      next_ += range_.every;
      if (going_ && playback_->way_ < 0) {
        next_ -= 2 * range_.every;
        at_next_ = false;
        if (next_ < range_.start) {  // no frame before it: stay where it was
          going_ = false;
          playback_->going_to_.reset();
          next_ = std::max(playback_->state_.position, range_.start - range_.every) + range_.every;
        }
      }
      break;
    case ReadStatus::end:  // the recording has fewer frames than announced
      end_ = next_;
      if (std::exchange(to_end_, false)) playback_->wanted_ = end_ - 1;
      result.status = ReadStatus::frame;
      break;
    case ReadStatus::timeout:
      break;
  }
  return result;
}

// Whether the next frame is the first one behind the part that is played.
bool PacedSource::leaves_part() const {
  const PlaybackState& state = playback_->state_;
  return state.out && !going_ && state.position <= *state.out &&
         (has_ahead_ ? ahead_.index : next_) > *state.out;
}

// Past the last frame of the part, or of the range: begins the next turn of the loop, or pauses. Returns
// `end` if no frame of the range was usable, else `frame`.
ReadResult PacedSource::turn_at_end() {
  PlaybackControls& p = *playback_;
  const bool part = p.state_.in || p.state_.out;
  if (!any_usable_ && !part) return {ReadStatus::end, ""};
  if (p.state_.loop && !p.state_.paused && any_usable_) {
    any_usable_ = false;
    jumped_ = true;
    next_ = nearest(p.state_.in.value_or(range_.start));
  } else {
    p.state_.paused = p.state_.at_end = true;
    going_ = false;
    p.going_to_.reset();
    if (has_ahead_) next_ = ahead_.index;
  }
  has_ahead_ = at_next_ = false;
  return {ReadStatus::frame, ""};
}

// Whether the frame read ahead may be given now; if it only has to wait, sets `when` to its time.
bool PacedSource::is_due(Time& when) {
  PlaybackControls& p = *playback_;
  if (going_) return true;
  const double speed = p.state_.speed;
  due_ = clock_->now();
  if (speed == 0) return p.taken_;
  if (p.rebase_ || !has_last_) return true;
  std::int64_t gap_us = ahead_.timestamp_us - last_.timestamp_us;
  if (gap_us <= 0)  // the loop has begun again
    gap_us = static_cast<std::int64_t>(1e6 / (info().rate_hz > 0 ? info().rate_hz : kUsualRate_hz));
  gap_us = std::min(gap_us, kLongestGap_us);
  const Time due = last_due_ + microseconds(static_cast<std::int64_t>(static_cast<double>(gap_us) / speed));
  when = due;
  if (due > due_) return false;
  if (due_ - due < kLateness) due_ = due;
  return true;
}

ReadResult PacedSource::give(Lock& lock, Frame& frame) {
  PlaybackControls& p = *playback_;
  std::swap(ahead_, last_);
  if (std::exchange(jumped_, false)) p.jump_ = {p.jump_.count + 1, last_.index};
  has_ahead_ = going_ = false;
  has_last_ = true;
  last_due_ = p.rebase_ ? clock_->now() : due_;
  p.rebase_ = false;
  p.state_.at_end = false;
  p.state_.position = last_.index;
  p.going_to_.reset();
  copy_last(frame);
  if (const auto tap = p.tap_) {
    lock.unlock();
    (*tap)(last_);
    lock.lock();
  }
  return {ReadStatus::frame, ""};
}

void PacedSource::copy_last(Frame& frame) {
  copy_frame(last_, frame);
  playback_->taken_ = false;
}

}  // namespace saccade
