#include <algorithm>
#include <chrono>
#include <string>

#include <imgui.h>

#include "ui/panels/panels.hpp"

namespace saccade {
namespace {

using Phase = SessionState::Phase;

struct Banner {
  Headline headline;
  std::string detail;
};

Banner banner_of(const ViewContext& view) {
  const SessionState& s = view.source;
  const Headline line = headline(source_facts(view), std::chrono::steady_clock::now());
  const bool there = s.phase == Phase::open && s.connection.connection == SourceState::Connection::streaming;
  if (there) return view.result ? Banner{} : Banner{{"Waiting for the first frame …", Tone::quiet}, ""};
  if (s.phase == Phase::open && s.connection.connection == SourceState::Connection::waiting)
    return {line, "It opens as soon as it is connected. If it is connected already, run: saccade doctor"};
  if (s.phase == Phase::open) return {line, s.connection.text};
  if (view.result) return {};  // the message bar says it, and the last picture stays
  if (s.phase == Phase::opening) return {line, s.uri};
  return {{"Nothing to show", Tone::quiet}, "Open a source, or drop a file or folder here."};
}

}  // namespace

SourceFacts source_facts(const ViewContext& view) {
  const SessionState& s = view.source;
  SourceFacts facts;
  facts.open = s.phase == Phase::open;
  facts.uri = s.uri;
  facts.live = s.source.live;
  facts.paused = view.playback.paused;
  facts.rate_hz = view.captured_hz;
  facts.connection = s.connection;
  facts.error = s.error;
  return facts;
}

void draw_state_banner(const ViewContext& view, ImVec2 low, ImVec2 high) {
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
}

}  // namespace saccade
