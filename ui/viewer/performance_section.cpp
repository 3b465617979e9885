#include "pipeline/processor.hpp"
#include "ui/performance_panel.hpp"
#include "ui/viewer/panels.hpp"

namespace saccade {

void draw_performance_section(ViewContext& view) {
  PerformanceFacts facts;
  facts.ledger = view.source.ledger;
  facts.workers = worker_count(view.state.tuning.a);
  facts.simd = view.state.tuning.a.simd;
  facts.source_rate_hz = view.source.source.rate_hz;
  if (view.longest_ms > 0) {
    facts.window_last_ms = view.busy_ms;
    facts.window_worst_ms = view.longest_ms;
  }
  draw_performance_panel(view.history, facts, StageHistory::Clock::now());
}

}  // namespace saccade
