#include "ui/session/settings_history.hpp"

namespace saccade {

void SettingsHistory::commit() {
  if (live_ == steps_[at_]) return;
  steps_.resize(at_ + 1, live_);
  steps_.push_back(live_);
  if (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
}

void SettingsHistory::undo() {
  commit();
  if (at_ > 0) live_ = steps_[--at_];
}

void SettingsHistory::redo() {
  if (can_redo()) live_ = steps_[++at_];
}

}  // namespace saccade
