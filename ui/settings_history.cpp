#include "ui/settings_history.hpp"

#include <algorithm>

namespace saccade {

bool same_settings(const Settings& a, const Settings& b) {
  const auto specs = setting_specs();
  return a.levels_chosen == b.levels_chosen &&
         std::all_of(specs.begin(), specs.end(),
                     [&](const SettingSpec& spec) { return spec.print(a) == spec.print(b); });
}

bool Tuning::operator==(const Tuning& other) const {
  return same_settings(a, other.a) && same_settings(b, other.b);
}

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
