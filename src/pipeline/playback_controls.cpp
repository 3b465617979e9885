#include "pipeline/playback_controls.hpp"

#include <algorithm>

namespace saccade {

void PlaybackControls::play() {
  {
    const std::lock_guard lock(mutex_);
    if (state_.at_end) wanted_ = state_.in.value_or(0);  // clamped to the range by the source
    state_.paused = state_.at_end = false;
    rebase_ = true;
    way_ = 1;
  }
  changed_.notify_all();
}

void PlaybackControls::pause() {
  {
    const std::lock_guard lock(mutex_);
    state_.paused = true;
  }
  changed_.notify_all();
}

void PlaybackControls::set_loop(bool loop) {
  const std::lock_guard lock(mutex_);
  state_.loop = loop;
}

void PlaybackControls::set_speed(double speed) {
  {
    const std::lock_guard lock(mutex_);
    state_.speed = speed > 0 ? std::clamp(speed, kSlowest, kFastest) : 0;
    rebase_ = true;
  }
  changed_.notify_all();
}

void PlaybackControls::set_in(std::optional<std::int64_t> index) {
  const std::lock_guard lock(mutex_);
  state_.in = index;
  if (index && state_.out && *state_.out < *index) state_.out.reset();
}

void PlaybackControls::set_out(std::optional<std::int64_t> index) {
  const std::lock_guard lock(mutex_);
  state_.out = index;
  if (index && state_.in && *state_.in > *index) state_.in.reset();
}

void PlaybackControls::step(std::int64_t frames) {
  {
    const std::lock_guard lock(mutex_);
    state_.paused = true;
    wanted_ = wanted_.value_or(going_to_.value_or(state_.position)) + frames;
    way_ = frames < 0 ? -1 : 1;
  }
  changed_.notify_all();
}

void PlaybackControls::seek(std::int64_t index) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = index;
    way_ = 1;
    state_.at_end = false;
  }
  changed_.notify_all();
}

void PlaybackControls::show_again() {
  {
    const std::lock_guard lock(mutex_);
    again_ = true;
  }
  changed_.notify_all();
}

void PlaybackControls::taken() {
  {
    const std::lock_guard lock(mutex_);
    taken_ = true;
  }
  changed_.notify_all();
}

void PlaybackControls::set_tap(std::function<void(const Frame&)> tap) {
  auto shared = tap ? std::make_shared<std::function<void(const Frame&)>>(std::move(tap)) : nullptr;
  const std::lock_guard lock(mutex_);
  tap_ = std::move(shared);
}

PlaybackState PlaybackControls::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

PlayJump PlaybackControls::last_jump() const {
  const std::lock_guard lock(mutex_);
  return jump_;
}

}  // namespace saccade
