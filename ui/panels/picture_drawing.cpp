#include "ui/panels/picture_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "models/model.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

void draw_shapes(ImDrawList& draw, const OverlayShapes& shapes, ImVec2 corner) {
  std::vector<ImVec2> points;
  for (const auto& line : shapes.lines) {
    points.clear();
    for (const cv::Point2f& p : line.points) points.emplace_back(corner.x + p.x, corner.y + p.y);
    draw.AddPolyline(points.data(), static_cast<int>(points.size()), as_u32(line.colour),
                     line.closed ? ImDrawFlags_Closed : ImDrawFlags_None, line.width);
  }
  for (const auto& mark : shapes.marks) {
    const ImVec2 centre{corner.x + mark.centre.x, corner.y + mark.centre.y};
    draw.AddCircleFilled(centre, mark.radius, IM_COL32(12, 14, 17, 225));
    draw.AddCircle(centre, mark.radius, as_u32(mark.rim), 0, mark.radius * 0.15F);
    const ImVec2 size = ImGui::CalcTextSize(mark.text.c_str());
    const float scale = std::min(1.0F, mark.radius * 1.45F / std::max(size.x, size.y));
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize() * scale,
                 {centre.x - size.x * scale / 2, centre.y - size.y * scale / 2}, as_u32(mark.rim),
                 mark.text.c_str());
  }
}

ImVec2 chip_pad(const ViewContext& view) { return {view.px(7), view.px(3)}; }

ImVec2 chip_size(const ViewContext& view, const std::string& text, float widest = 0) {
  const ImVec2 pad = chip_pad(view);
  const float wrap = widest > 0 ? std::max(1.0F, widest - 2 * pad.x) : -1;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  return {size.x + 2 * pad.x, size.y + 2 * pad.y};
}

// Text on a dark background, in lines of at most `widest` px; 0 = one line.
void draw_chip(const ViewContext& view, ImVec2 corner, const std::string& text, unsigned colour,
               float widest = 0) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 size = chip_size(view, text, widest), pad = chip_pad(view);
  draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, view.colours->chip, view.px(5));
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {corner.x + pad.x, corner.y + pad.y}, colour,
               text.c_str(), nullptr, widest > 0 ? std::max(1.0F, widest - 2 * pad.x) : 0.0F);
}

// The model and its kernel, at the top; only A or B where there is no room.
void draw_title(const ViewContext& view, const Computed& computed, const PictureSide& side) {
  const float pad = view.px(8), room = side.clip_high.x - side.clip_low.x - 2 * pad;
  const Settings& s = computed.settings;
  const std::string letter = !view.state.comparing() ? "" : side.is_b ? "B" : "A";
  std::string text = fmt::format("{}{}{}", letter, letter.empty() ? "" : "  ", s.model);
  if (computed.draft)
    text += fmt::format("  draft: kernel {} on levels {}..{}", s.kernel, s.first_level, s.last_level);
  else if (needs_depth(s.model))
    text += fmt::format("  kernel {}", s.kernel);
  if (chip_size(view, text).x > room) text = letter;
  const float width = chip_size(view, text).x;
  const float y = side.clip_low.y + pad;
  if (!text.empty() && width <= room) {
    const bool at_right = side.is_b && view.state.comparison == Comparison::split;
    draw_chip(view, {at_right ? side.clip_high.x - pad - width : side.clip_low.x + pad, y}, text,
              view.colours->on_picture);
  }
  if (!computed.error.empty() && room > view.px(60))
    draw_chip(view, {side.clip_low.x + pad, y + chip_size(view, "A").y + view.px(4)}, computed.error,
              colours_of(Theme::dark).error, room);
}

struct Legend {
  std::string low, high;                          // the values at its ends
  std::function<cv::Vec3b(double share)> colour;  // BGR
};

// Returns its height; draws nothing and returns 0 where there is no room.
float draw_legend(const ViewContext& view, const Legend& legend, ImVec2 right_bottom, float room) {
  const ImVec2 low = ImGui::CalcTextSize(legend.low.c_str()), high = ImGui::CalcTextSize(legend.high.c_str());
  const float pad = view.px(6), texts = low.x + high.x + 4 * pad;
  const float width = std::min(view.px(96), room - texts), bar = view.px(8);
  if (width < view.px(20)) return 0;
  const float height = high.y + view.px(6);
  const ImVec2 corner{right_bottom.x - texts - width, right_bottom.y - height};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, right_bottom, view.colours->chip, view.px(5));
  const float y = corner.y + height / 2, x = corner.x + 2 * pad + low.x;
  draw.AddText({corner.x + pad, y - low.y / 2}, view.colours->on_picture, legend.low.c_str());
  draw.AddText({x + width + pad, y - high.y / 2}, view.colours->on_picture, legend.high.c_str());
  constexpr int kPieces = 32;
  for (int i = 0; i < kPieces; ++i) {
    const cv::Vec3b c = legend.colour((i + 0.5) / kPieces);
    const float x0 = x + width * static_cast<float>(i) / kPieces;
    draw.AddRectFilled({x0, y - bar / 2}, {x0 + width / kPieces + 0.5F, y + bar / 2},
                       IM_COL32(c[2], c[1], c[0], 255));
  }
  return height;
}

Legend map_legend(const Computed& computed, const MapStyle& style) {
  const ValueRange range = shown_range(computed.smooth, style);
  return {fmt::format("{:.2g}", range.low), fmt::format("{:.2g}", range.high), [&style](double share) {
            // As on the picture, the strength is the square root of the place in the range.
            return colours_of(style.palette)[static_cast<std::size_t>(255 * std::sqrt(share))];
          }};
}

// The legends, stacked in the lower right corner; returns the y of their top.
float draw_legends(const ViewContext& view, const Computed& computed, const PictureSide& side,
                   std::optional<ValueRange> depth_range) {
  const float pad = view.px(8), room = side.clip_high.x - side.clip_low.x - 2 * pad;
  ImVec2 at{side.clip_high.x - pad, side.clip_high.y - pad};
  const auto add = [&](const Legend& legend) {
    const float height = draw_legend(view, legend, at, room);
    if (height > 0) at.y -= height + view.px(4);
  };
  if (view.state.show_map && computed.error.empty()) add(map_legend(computed, view.state.style.map));
  if (depth_range)
    add({fmt::format("{:.0f} mm", depth_range->low), fmt::format("{:.0f} mm", depth_range->high),
         [&](double share) { return depth_colour(view.state.style.depth.palette, share); }});
  return at.y;
}

// The values under the mouse; beside the legends, or above them where there is no room.
void draw_pointer(const ViewContext& view, const Computed& computed, const PictureSide& side,
                  float legends_top) {
  if (!view.pointer || view.pointer_on_b != side.is_b) return;
  const cv::Point p = *view.pointer;
  const float depth = view.result->frame().depth_mm(p), pad = view.px(8);
  const std::string text =
      fmt::format("row {}  col {}   {}   saliency {:.2f}", p.y, p.x,
                  depth > 0 ? fmt::format("{:.0f} mm", depth) : "no depth", computed.result.maps.master(p));
  const ImVec2 size = chip_size(view, text);
  const float widest_legend = view.px(96 + 24) + ImGui::CalcTextSize("00000 mm00000 mm").x;
  const bool beside = side.clip_high.x - side.clip_low.x > size.x + widest_legend + 3 * pad;
  const float bottom = beside ? side.clip_high.y - pad : legends_top;
  draw_chip(view, {side.clip_low.x + pad, bottom - size.y}, text, view.colours->on_picture);
}

// The tool tip of the fixation under the mouse.
void explain_fixation(const Computed& computed, const OverlayShapes& shapes, cv::Point2d at) {
  const int rank = mark_under(shapes, at);
  if (rank < 0) return;
  const Fixation& f = computed.result.attention.fixations[static_cast<std::size_t>(rank)];
  std::string text =
      fmt::format("Fixation {}\nrow {}, column {}\nsaliency {:.3f}", rank + 1, f.row, f.col, f.saliency);
  if (f.confidence) text += fmt::format("\nconfidence {:.2f}", *f.confidence);
  text += f.position_mm.z > 0 ? fmt::format("\nx y z {:.0f}, {:.0f}, {:.0f} mm", f.position_mm.x,
                                            f.position_mm.y, f.position_mm.z)
                              : "\nno depth there";
  if (f.proto_object.pixels > 0)
    text += fmt::format("\nobject of {} pixels, {:.0f} x {:.0f} x {:.0f} mm", f.proto_object.pixels,
                        f.proto_object.extent_mm.x, f.proto_object.extent_mm.y, f.proto_object.extent_mm.z);
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

void draw_over_picture(ViewContext& view, const PictureSide& side, const PictureView& picture,
                       std::optional<ValueRange> depth_range) {
  const Computed& computed = side.is_b ? view.result->b : view.result->a;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(side.clip_low, side.clip_high, true);
  const OverlayShapes shapes = overlay_shapes(computed, view.state.style, picture, view.unit);
  draw_shapes(draw, shapes, side.corner);
  const cv::Point2d origin = picture.to_panel({0, 0});
  if (view.over_picture)
    view.over_picture(
        draw, {{side.corner.x + static_cast<float>(origin.x), side.corner.y + static_cast<float>(origin.y)},
               side.clip_low,
               side.clip_high,
               static_cast<float>(picture.scale())});
  draw_title(view, computed, side);
  const float legends_top = draw_legends(view, computed, side, depth_range);
  draw_pointer(view, computed, side, legends_top);
  draw.PopClipRect();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (view.pointer && view.pointer_on_b == side.is_b && !ImGui::IsMouseDown(ImGuiMouseButton_Left))
    explain_fixation(computed, shapes, as_point({mouse.x - side.corner.x, mouse.y - side.corner.y}));
}

void draw_divider(ViewContext& view, const PictureSide& whole) {
  const float x = whole.corner.x + whole.size.x * static_cast<float>(view.state.divider);
  const float top = whole.corner.y, bottom = top + whole.size.y;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddLine({x, top}, {x, bottom}, IM_COL32(0, 0, 0, 160), view.px(4));
  draw.AddLine({x, top}, {x, bottom}, view.colours->on_picture, view.px(1.5));
  draw.AddCircleFilled({x, (top + bottom) / 2}, view.px(8), IM_COL32(0, 0, 0, 160));
  draw.AddCircleFilled({x, (top + bottom) / 2}, view.px(7), view.colours->on_picture);
  view.places["divider"] = {x - view.px(5), top, x + view.px(5), bottom};
}

}  // namespace saccade
