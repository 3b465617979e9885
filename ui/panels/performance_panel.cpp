#include "pipeline/processor.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/performance_drawing.hpp"

namespace saccade {

void draw_performance_panel(ViewContext& view) {
  PerformanceFacts facts;
  facts.ledger = view.source.ledger;
  facts.workers = worker_count(view.state.settings.a);
  facts.simd = view.state.settings.a.simd;
  facts.source_rate_hz = view.source.source.rate_hz;
  if (view.longest_ms > 0) {
    facts.window_last_ms = view.busy_ms;
    facts.window_worst_ms = view.longest_ms;
  }
  draw_performance(view.history, facts, StageHistory::Clock::now());
}

}  // namespace saccade
