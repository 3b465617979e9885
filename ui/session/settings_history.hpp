#pragma once

#include <cstddef>
#include <vector>

#include "ui/session/compared_settings.hpp"

namespace saccade {

/// Undo and redo of the settings. The drag of a slider is one step: change() with any number of values, and
/// commit() at the end.
class SettingsHistory {
 public:
  static constexpr std::size_t kMostSteps = 200;

  explicit SettingsHistory(ComparedSettings start) : steps_{std::move(start)} {}

  [[nodiscard]] const ComparedSettings& now() const { return live_; }

  /// Replaces the present values without a step.
  void change(const ComparedSettings& settings) { live_ = settings; }

  /// Makes the changes since the last step a step, and drops the steps that could be redone.
  void commit();

  [[nodiscard]] bool can_undo() const { return at_ > 0 || !(live_ == steps_[at_]); }
  [[nodiscard]] bool can_redo() const { return at_ + 1 < steps_.size() && live_ == steps_[at_]; }
  void undo();
  void redo();

 private:
  std::vector<ComparedSettings> steps_;
  std::size_t at_ = 0;
  ComparedSettings live_ = steps_.front();
};

}  // namespace saccade
