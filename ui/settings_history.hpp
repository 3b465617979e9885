#pragma once

#include <cstddef>
#include <vector>

#include "core/settings.hpp"

namespace saccade {

/// The settings that a person tunes: A's, and B's for comparison.
struct Tuning {
  Settings a, b;
  bool operator==(const Tuning& other) const;
};

/// True if both print the same values for every setting.
bool same_settings(const Settings& a, const Settings& b);

/// Undo and redo of a tuning. A slider that is dragged is one step: call begin() when it is taken up, or
/// change() with any number of values and commit() at the end.
class SettingsHistory {
 public:
  static constexpr std::size_t kMostSteps = 200;

  explicit SettingsHistory(Tuning start) : steps_{std::move(start)} {}

  const Tuning& now() const { return live_; }

  /// Shows other values without a step of their own yet.
  void change(const Tuning& tuning) { live_ = tuning; }

  /// What was changed since the last step becomes one; what could be redone is gone. No change, no step.
  void commit();

  bool can_undo() const { return at_ > 0 || !(live_ == steps_[at_]); }
  bool can_redo() const { return at_ + 1 < steps_.size() && live_ == steps_[at_]; }
  void undo();
  void redo();

 private:
  std::vector<Tuning> steps_;
  std::size_t at_ = 0;
  Tuning live_ = steps_.front();
};

}  // namespace saccade
