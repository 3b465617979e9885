#include <algorithm>
#include <chrono>
#include <string>

#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

using Phase = SessionState::Phase;

bool waits_for_sensor(const SessionState& s) {
  return s.phase == Phase::open && s.connection.connection == SourceState::Connection::waiting;
}

struct Banner {
  Headline headline;
  std::string detail;
};

std::string waiting_text(const ViewContext& view) {
  std::string text = "It opens as soon as it is connected.";
  for (const std::string& line : view.advice) text += "\n" + line;
  if (view.advice.empty()) text += "\nIf it is connected already, run: saccade doctor";
  return text;
}

Banner banner_of(const ViewContext& view) {
  const SessionState& s = view.source;
  const Headline line = headline(source_facts(view), std::chrono::steady_clock::now());
  const bool there = s.phase == Phase::open && s.connection.connection == SourceState::Connection::streaming;
  if (there) return view.result ? Banner{} : Banner{{"Waiting for the first frame …", Tone::quiet}, ""};
  if (waits_for_sensor(s)) return {line, waiting_text(view)};
  if (s.phase == Phase::open) return {line, s.connection.text};
  if (view.result) return {};  // the message bar says it, and the last picture stays
  if (!s.opening.empty()) return {line, s.opening};
  return {{"Nothing to show", Tone::quiet}, "Open a source, or drop a file or folder here."};
}

}  // namespace

SourceFacts source_facts(const ViewContext& view) {
  const SessionState& s = view.source;
  SourceFacts facts;
  facts.open = s.phase == Phase::open;
  facts.opening = s.phase != Phase::open && !s.opening.empty();
  facts.uri = s.uri;
  facts.live = s.source.live;
  facts.paused = view.playback.paused;
  facts.rate_hz = view.captured_hz;
  facts.connection = s.connection;
  facts.error = s.error;
  return facts;
}

namespace {

// Below the text of the banner, at `top`.
void draw_retry(ViewContext& view, float middle, float top) {
  const float width = view.px(110);
  ImGui::SetCursorScreenPos({middle - width / 2, top});
  ImGui::BeginChild("retry", {width, ImGui::GetFrameHeight()}, false, ImGuiWindowFlags_NoBackground);
  if (ImGui::Button("Retry", {width, 0})) view.open(view.source.uri);
  log_place(view, "retry");
  explain("Looks for the sensor again, with the drivers as they are now");
  ImGui::EndChild();
}

}  // namespace

void draw_state_banner(ViewContext& view, ImVec2 low, ImVec2 high) {
  const Banner banner = banner_of(view);
  const std::string& text = banner.headline.text;
  if (text.empty()) return;
  ImFont& large = *view.fonts.large;
  const float wrap = std::max(view.px(60), 0.8F * (high.x - low.x)), gap = view.px(6);
  const ImVec2 size = large.CalcTextSizeA(large.FontSize, 1e9F, wrap, text.c_str());
  const ImVec2 detail = ImGui::CalcTextSize(banner.detail.c_str(), nullptr, false, wrap);
  const float width = std::max(size.x, detail.x), height = size.y + (detail.x > 0 ? gap + detail.y : 0);
  const float middle = (low.x + high.x) / 2;
  // Over a picture it is higher up, on a background of its own.
  const float top = view.result ? low.y + 0.2F * (high.y - low.y) : (low.y + high.y - height) / 2;
  // A window of its own, over those drawn before it; the mouse passes through.
  ImGui::SetCursorScreenPos(low);
  ImGui::BeginChild("banner", {high.x - low.x, high.y - low.y}, false,
                    ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (view.result)
    draw.AddRectFilled({middle - width / 2 - view.px(18), top - view.px(12)},
                       {middle + width / 2 + view.px(18), top + height + view.px(12)},
                       (view.colours->panel & 0x00ffffff) | 0xe6000000, view.px(10));
  draw.AddText(&large, large.FontSize, {middle - size.x / 2, top},
               ImGui::GetColorU32(tone_colour(banner.headline.tone)), text.c_str(), nullptr, wrap);
  if (detail.x > 0)
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {middle - detail.x / 2, top + size.y + gap},
                 ImGui::GetColorU32(tone_colour(Tone::plain)), banner.detail.c_str(), nullptr, wrap);
  ImGui::EndChild();
  if (waits_for_sensor(view.source))  // in sight even if the text is long
    draw_retry(view, middle,
               std::min(top + height + view.px(14), high.y - ImGui::GetFrameHeight() - view.px(6)));
}

}  // namespace saccade
