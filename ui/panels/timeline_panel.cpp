#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

// The line on screen, and the frames that it shows.
struct Line {
  ImVec2 corner;
  float width, height;
  std::int64_t frames;
  VisibleFrames visible;

  float x_of(double place) const {
    return corner.x +
           static_cast<float>((place - visible.first) / visible.count * static_cast<double>(width));
  }
  double share_at(float x) const { return static_cast<double>((x - corner.x) / width); }
  std::int64_t frame_under(float x) const {
    return frame_at(static_cast<double>(x - corner.x), static_cast<double>(width), visible);
  }
};

// A bar for each computed frame: its largest saliency.
void draw_strengths(const ViewContext& view, const Line& line) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float largest = view.timeline.largest();
  if (!(largest > 0)) return;
  const float width = std::max(1.0F, line.width / static_cast<float>(line.visible.count) - view.px(1));
  const float bottom = line.corner.y + line.height;
  for (const TimelineBar& bar :
       timeline_bars(view.timeline.entries(), line.visible, static_cast<double>(line.width))) {
    const float x = line.corner.x + static_cast<float>(bar.x);
    const float height = std::max(1.0F, std::min(1.0F, bar.strength / largest) * line.height);
    draw.AddRectFilled({x - width / 2, bottom - height}, {x + width / 2, bottom},
                       bar.current ? view.colours->plot : view.colours->plot_old);
  }
}

void draw_ticks(const ViewContext& view, const Line& line) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float label = ImGui::CalcTextSize(fmt::format("{}", line.frames).c_str()).x + view.px(16);
  const std::int64_t step =
      tick_step(static_cast<double>(line.width), line.visible, static_cast<double>(label));
  const std::int64_t last = line.frame_under(line.corner.x + line.width);
  for (std::int64_t i = (line.frame_under(line.corner.x) + step - 1) / step * step; i <= last; i += step) {
    const std::string text = fmt::format("{}", i);
    draw.AddText({line.x_of(static_cast<double>(i) + 0.5) - ImGui::CalcTextSize(text.c_str()).x / 2,
                  line.corner.y + line.height + view.px(3)},
                 view.colours->dim_text, text.c_str());
  }
}

// Covers the frames that are not played, and draws a bracket at each bound.
void draw_part(const ViewContext& view, const Line& line) {
  const PlaybackState& playing = view.playback;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float left = line.corner.x, right = left + line.width, top = line.corner.y,
              bottom = top + line.height;
  const ImU32 cover = ImGui::GetColorU32(ImGuiCol_WindowBg, 0.7F);
  const auto bracket = [&](float x, float way) {
    for (const float y : {top, bottom})
      draw.AddLine({x, y}, {x + way * view.px(5), y}, view.colours->accent, view.px(2));
    draw.AddLine({x, top}, {x, bottom}, view.colours->accent, view.px(2));
  };
  if (playing.in) {
    const float x = line.x_of(static_cast<double>(*playing.in));
    draw.AddRectFilled({left, top}, {std::clamp(x, left, right), bottom}, cover);
    if (x >= left && x <= right) bracket(x, 1);
  }
  if (playing.out) {
    const float x = line.x_of(static_cast<double>(*playing.out + 1));
    draw.AddRectFilled({std::clamp(x, left, right), top}, {right, bottom}, cover);
    if (x >= left && x <= right) bracket(x, -1);
  }
}

void seek_with_mouse(ViewContext& view, const Line& line) {
  const ImGuiIO& io = ImGui::GetIO();
  const std::int64_t under = line.frame_under(io.MousePos.x);
  const bool moved = ImGui::IsMouseClicked(ImGuiMouseButton_Left) || io.MouseDelta.x != 0;
  if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left) && moved &&
      under != view.playback.position)
    view.session.playback().seek(under);
}

// A drag with the right button marks the part that is played; a click with it removes the bounds.
void mark_part_with_mouse(ViewContext& view, const Line& line) {
  PlaybackControls& playback = view.session.playback();
  if (!ImGui::IsItemActive()) return;
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Right)) {
    const float to = ImGui::GetIO().MousePos.x;
    const float from = to - ImGui::GetMouseDragDelta(ImGuiMouseButton_Right).x;
    playback.set_out(std::nullopt);
    playback.set_in(line.frame_under(std::min(from, to)));
    playback.set_out(line.frame_under(std::max(from, to)));
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    playback.set_in(std::nullopt);
    playback.set_out(std::nullopt);
  }
}

void zoom_with_mouse(ViewContext& view, const Line& line) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    const auto steps = static_cast<double>(io.MouseWheel);
    if (io.KeyShift)
      view.timeline_zoom.pan(-steps / 10, line.frames);
    else
      view.timeline_zoom.zoom(steps, line.share_at(io.MousePos.x), line.frames);
  }
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Middle))
    view.timeline_zoom.pan(static_cast<double>(-io.MouseDelta.x / line.width), line.frames);
}

void explain_frame_under_mouse(const ViewContext& view, const Line& line) {
  if (!ImGui::IsItemHovered()) return;
  const std::int64_t under = line.frame_under(ImGui::GetIO().MousePos.x);
  const auto& entries = view.timeline.entries();
  const auto place = static_cast<std::size_t>(under);
  const bool seen = place < entries.size() && entries[place].seen;
  const std::string saliency =
      seen ? "largest saliency " + saliency_text(entries[place].strength) : "not computed yet";
  const std::string text = fmt::format(
      "frame {}, {}\n\nDrag: move through the recording. Wheel: zoom, with Shift move.\n"
      "Right drag: mark the part to play (keys {}, {}); right click: play all",
      under, saliency, key_name(Action::mark_in), key_name(Action::mark_out));
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

void draw_timeline(ViewContext& view, std::int64_t frames) {
  if (view.result) view.timeline_zoom.follow(view.result->frame().index, frames);
  const Line line{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail().x, view.px(34), frames,
                  view.timeline_zoom.visible(frames)};
  const ImVec2 end{line.corner.x + line.width, line.corner.y + line.height};
  ImGui::InvisibleButton("##timeline", {line.width, line.height + ImGui::GetFontSize() + view.px(3)},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  view.places["timeline"] = {line.corner.x, line.corner.y, end.x, end.y};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(line.corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), view.px(4));
  draw_strengths(view, line);
  draw_part(view, line);
  draw_ticks(view, line);
  seek_with_mouse(view, line);
  mark_part_with_mouse(view, line);
  zoom_with_mouse(view, line);
  explain_frame_under_mouse(view, line);
  if (!view.result) return;
  const float x = line.x_of(static_cast<double>(view.result->frame().index) + 0.5);
  if (x >= line.corner.x && x <= end.x)
    draw.AddLine({x, line.corner.y - view.px(2)}, {x, end.y + view.px(2)}, view.colours->accent, view.px(2));
}

}  // namespace saccade
