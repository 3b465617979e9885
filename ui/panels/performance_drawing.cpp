#include "ui/panels/performance_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "core/text.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

constexpr std::array<const char*, StageHistory::kStages> kLabels = {"capture", "points, normals", "symmetry",
                                                                    "master map", "attention"};
constexpr std::array<const char*, StageHistory::kStages> kExplanations = {
    "Reading and decoding the frame, and waiting for it: mostly waiting with a live sensor, or with a "
    "recording at its own speed.",
    "Pyramid, points and normals of every level.",
    "The symmetry operator at every level (other models: all of their work).",
    "Resizing the levels to full size and adding them.",
    "Choosing the fixations and growing their proto-objects."};

std::string milliseconds(double ms) { return fmt::format("{:.{}f}", ms, ms < 100 ? 1 : 0); }

void duration_row(const DurationSummary& summary) {
  for (const double ms : {summary.last_ms, summary.p50_ms, summary.p95_ms}) number_cell(milliseconds(ms));
}

void draw_rates(const StageHistory& history, const PerformanceFacts& facts,
                StageHistory::Clock::time_point now) {
  if (!begin_labelled_rows("rates", "frame rate")) return;
  const double rate_hz = history.rate_hz(now);
  std::string rate = rate_hz > 0 ? fmt::format("{:.1f} frames/s", rate_hz) : "no new frames";
  if (facts.source_rate_hz > 0) rate += fmt::format(" (source: {:.1f})", facts.source_rate_hz);
  labelled_row("frame rate", rate, Tone::plain,
               "Computed frames per second, and the rate that the source has by itself.");
  const DurationSummary latency = history.latency();
  labelled_row("latency",
               history.size() == 0 ? "-"
                                   : fmt::format("{} ms (median {}, 95 % {})", milliseconds(latency.last_ms),
                                                 milliseconds(latency.p50_ms), milliseconds(latency.p95_ms)),
               Tone::plain, "From the capture of a frame until its result can be shown.");
  if (facts.window_last_ms && facts.window_worst_ms)
    labelled_row("window",
                 fmt::format("{} ms to draw (longest {})", milliseconds(*facts.window_last_ms),
                             milliseconds(*facts.window_worst_ms)),
                 *facts.window_worst_ms > 50 ? Tone::warning : Tone::plain,
                 "Time to draw the window, of the last frame and of the slowest since the start.");
  labelled_row("computing", fmt::format("{}, SIMD {}", counted(facts.workers, "worker"), facts.simd),
               Tone::plain, "Threads that compute, and the instructions that they use.");
  ImGui::EndTable();
}

void draw_stages(const StageHistory& history) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("stages", 4, kFlags)) return;
  ImGui::TableSetupColumn("stage, ms", ImGuiTableColumnFlags_WidthStretch, 2.4F);
  for (const char* name : {"last", "median", "95 %"})
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  wrapped_text("stage", Tone::quiet);
  for (const char* name : {"last ms", "median", "95 %"}) number_cell(name, Tone::quiet);
  for (std::size_t i = 0; i < StageHistory::kStages; ++i) {
    ImGui::TableNextColumn();
    swatch(series_colour(static_cast<int>(i)));
    ImGui::TextUnformatted(kLabels[i]);
    explain(kExplanations[i]);
    duration_row(history.stage(static_cast<Stage>(i)));
  }
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("all stages");
  explain("The sum of the stages of a frame.");
  duration_row(history.total());
  ImGui::EndTable();
}

// The place of the plot on the screen, and its scale.
struct Plot {
  ImVec2 low_left, top_right;
  double end_ms;
  float bar_px;

  float y_of(double ms) const {
    const auto share = static_cast<float>(ms / end_ms);
    return low_left.y - std::min(share, 1.0F) * (low_left.y - top_right.y);
  }
};

void draw_axis(ImDrawList& list, const Plot& plot) {
  ImVec4 faint = tone_colour(Tone::quiet);
  faint.w = 0.35F;
  const ImU32 line = ImGui::GetColorU32(faint);
  const ImU32 text = ImGui::GetColorU32(tone_colour(Tone::quiet));
  for (const double share : {0.0, 0.5, 1.0}) {
    const double ms = share * plot.end_ms;
    const float y = plot.y_of(ms);
    const std::string label = share == 1 ? fmt::format("{:g} ms", ms) : fmt::format("{:g}", ms);
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    list.AddLine({plot.low_left.x, y}, {plot.top_right.x, y}, line);
    list.AddText({plot.low_left.x - size.x - size.y / 3, y - size.y / 2}, text, label.c_str());
  }
}

void draw_bars(ImDrawList& list, const Plot& plot, const std::vector<StageHistory::Stack>& stacks) {
  float x = plot.top_right.x - plot.bar_px * static_cast<float>(stacks.size());
  for (const StageHistory::Stack& stack : stacks) {
    float below = plot.low_left.y;
    for (std::size_t i = 0; i < stack.size(); ++i) {
      const float above = plot.y_of(static_cast<double>(stack[i]));
      if (below - above > 0)
        list.AddRectFilled({x, above}, {x + plot.bar_px, below}, series_colour(static_cast<int>(i)));
      below = above;
    }
    x += plot.bar_px;
  }
}

void explain_bar_under_pointer(const Plot& plot, const std::vector<StageHistory::Stack>& stacks) {
  if (!ImGui::IsItemHovered()) return;
  const float from_right = (plot.top_right.x - ImGui::GetMousePos().x) / plot.bar_px;
  const auto back = static_cast<std::size_t>(std::max(from_right, 0.0F));
  if (back >= stacks.size()) return;
  const StageHistory::Stack& stack = stacks[stacks.size() - 1 - back];
  ImGui::BeginTooltip();
  ImGui::TextUnformatted((back == 0 ? "the last frame" : counted(back, "frame") + " ago").c_str());
  for (std::size_t i = stack.size(); i-- > 0;) {
    const float below = i == 0 ? 0 : stack[i - 1];
    swatch(series_colour(static_cast<int>(i)));
    ImGui::TextUnformatted(fmt::format("{} {:.1f} ms", kLabels[i], stack[i] - below).c_str());
  }
  ImGui::EndTooltip();
}

void draw_plot(const StageHistory& history) {
  constexpr std::size_t kFewestBars =
      60;  // the plot has room for them, so that the first frames do not fill it
  const std::vector<StageHistory::Stack> stacks = history.stacks();
  const float em = ImGui::GetFontSize(), height = 8 * em;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 12 * em);
  ImGui::InvisibleButton("plot", {width, height});
  // A single slow frame must not flatten the rest: the axis is for 98 % of them.
  std::vector<float> totals;
  totals.reserve(stacks.size());
  for (const StageHistory::Stack& stack : stacks) totals.push_back(stack.back());
  std::sort(totals.begin(), totals.end());
  const double largest = totals.empty() ? 0 : static_cast<double>(totals[(totals.size() - 1) * 98 / 100]);
  Plot plot;
  plot.low_left = {at.x + 4.5F * em, at.y + height - 0.7F * em};
  plot.top_right = {at.x + width, at.y + 0.7F * em};
  plot.end_ms = axis_end(std::max(largest, 1.0));
  plot.bar_px = (plot.top_right.x - plot.low_left.x) /
                static_cast<float>(std::max<std::size_t>(stacks.size(), kFewestBars));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_axis(list, plot);
  draw_bars(list, plot, stacks);
  explain_bar_under_pointer(plot, stacks);
}

void draw_ledger(const Ledger& ledger) {
  if (!begin_labelled_rows("ledger", "frame rate")) return;
  const auto count = [](std::int64_t frames) { return fmt::format("{}", frames); };
  const auto trouble = [](std::int64_t frames) { return frames > 0 ? Tone::warning : Tone::plain; };
  labelled_row(
      "captured", count(ledger.captured), Tone::plain,
      "Frames of the source. Captured = processed + overtaken + stopped + rejected + in flight: nothing is "
      "lost silently.");
  labelled_row("processed", count(ledger.processed), Tone::plain, "Frames that were computed.");
  labelled_row("overtaken", count(ledger.replaced), trouble(ledger.replaced),
               "Dropped because a newer frame came before their turn: the model is slower than the source.");
  labelled_row("stopped", count(ledger.stopped()), trouble(ledger.stopped()),
               "Dropped because the pipeline was stopped, or failed, before they were computed.");
  labelled_row("rejected", count(ledger.rejected), ledger.rejected > 0 ? Tone::bad : Tone::plain,
               "Not usable: unreadable, or of another size than the source said.");
  labelled_row("in flight", count(ledger.in_flight()), Tone::plain, "Being computed, or waiting for it.");
  ImGui::EndTable();
}

}  // namespace

double axis_end(double largest) {
  const double decade = std::pow(10.0, std::floor(std::log10(largest)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= largest) return step * decade;
  return 10 * decade;
}

void draw_performance(const StageHistory& history, const PerformanceFacts& facts,
                      StageHistory::Clock::time_point now) {
  draw_rates(history, facts, now);
  ImGui::Spacing();
  draw_stages(history);
  ImGui::Spacing();
  draw_plot(history);
  ImGui::Spacing();
  wrapped_text("Frames", Tone::quiet);
  draw_ledger(facts.ledger);
}

}  // namespace saccade
