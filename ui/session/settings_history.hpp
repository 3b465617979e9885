#pragma once

#include <cstddef>
#include <vector>

#include "ui/session/compared_settings.hpp"

namespace saccade {

/// Undo and redo of the settings. A slider that is dragged is one step: change() with any
/// number of values, and commit() at the end.
class SettingsHistory {
 public:
  static constexpr std::size_t kMostSteps = 200;

  explicit SettingsHistory(ComparedSettings start) : steps_{std::move(start)} {}

  const ComparedSettings& now() const { return live_; }

  /// Shows other values without a step of their own yet.
  void change(const ComparedSettings& settings) { live_ = settings; }

  /// What was changed since the last step becomes one; what could be redone is gone. No change, no step.
  void commit();

  bool can_undo() const { return at_ > 0 || !(live_ == steps_[at_]); }
  bool can_redo() const { return at_ + 1 < steps_.size() && live_ == steps_[at_]; }
  void undo();
  void redo();

 private:
  std::vector<ComparedSettings> steps_;
  std::size_t at_ = 0;
  ComparedSettings live_ = steps_.front();
};

}  // namespace saccade
