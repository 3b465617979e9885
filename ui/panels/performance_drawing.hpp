#pragma once

#include <optional>
#include <string>

#include "pipeline/ledger.hpp"
#include "ui/session/stage_history.hpp"

namespace saccade {

/// Values of the performance panel besides the stage times.
struct PerformanceFacts {
  Ledger ledger{};
  int workers = 1;                          ///< threads that compute
  std::string simd{};                       ///< the requested instruction set of the operator
  double source_rate_hz = 0;                ///< nominal; 0 = not known
  std::optional<double> window_last_ms{};   ///< drawing time of the window's last frame
  std::optional<double> window_worst_ms{};  ///< of the longest so far
};

/// Draws the panel: frame rate and latency, the stages' times (last, median, 95th percentile) with a stacked
/// plot over the last frames, and the ledger of frames. Within an ImGui window, on the thread that draws.
void draw_performance(const StageHistory& history, const PerformanceFacts& facts,
                      StageHistory::Clock::time_point now);

/// The end of a plot's axis that reaches at least `largest` > 0: 1, 2 or 5 times a power of ten.
[[nodiscard]] double axis_end(double largest);

}  // namespace saccade
