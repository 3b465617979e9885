#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

namespace saccade {

/// The stages of the processing of a frame that are timed.
enum class Stage { capture, points, symmetry, master_map, attention, count };

constexpr std::array<std::string_view, static_cast<std::size_t>(Stage::count)> kStageNames = {
    "capture", "points", "symmetry", "master_map", "attention"};

/// Wall time of each stage of one frame, in milliseconds. `points` holds pyramid, points and normals.
class StageTimes {
 public:
  double& operator[](Stage stage) { return ms_[static_cast<std::size_t>(stage)]; }
  double operator[](Stage stage) const { return ms_[static_cast<std::size_t>(stage)]; }

 private:
  std::array<double, static_cast<std::size_t>(Stage::count)> ms_{};
};

/// Adds the time from its construction to its destruction to one stage.
class StageTimer {
 public:
  StageTimer(StageTimes& times, Stage stage) : times_(times), stage_(stage) {}
  ~StageTimer() {
    times_[stage_] += std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  StageTimes& times_;
  Stage stage_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace saccade
