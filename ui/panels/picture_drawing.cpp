#include "ui/panels/picture_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "models/model.hpp"
#include "ui/panels/picture_clicks.hpp"
#include "ui/panels/widgets.hpp"
#include "ui/session/map_difference.hpp"

namespace saccade {

bool shows_difference(const ViewContext& view) {
  const ViewResult* result = view.result.get();
  return result != nullptr && result->compared && view.state.comparison == Comparison::difference &&
         result->a.smooth.size() == result->b.smooth.size();
}

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
                 {centre.x - size.x * scale / 2, centre.y - size.y * scale / 2},
                 IM_COL32(255, 255, 255, mark.rim.a), mark.text.c_str());  // dark colours cannot be read
  }
  for (const auto& ring : shapes.rings)
    draw.AddCircle({corner.x + ring.centre.x, corner.y + ring.centre.y}, ring.radius, as_u32(ring.colour), 0,
                   ring.width);
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

// Why the picture is not what the user expects; empty = it is.
std::string remark(const ViewContext& view, const Computed& computed) {
  const Frame& frame = view.result->frame();
  const OverlayStyle& style = view.state.style;
  if (frame.colour.empty() && style.background == Background::colour &&
      view.last_colour.size() == frame.size())
    return fmt::format("no colour in this frame: that of frame {}", view.last_colour_index);
  if (!view.state.show_map || !style.map.range || !computed.error.empty()) return "";
  double largest = 0;
  cv::minMaxLoc(computed.smooth, nullptr, &largest);
  const ValueRange& range = *style.map.range;
  if (largest <= static_cast<double>(range.low) + 0.01 * static_cast<double>(range.high - range.low))
    return "below the locked range (local mean up to " + saliency_text(static_cast<float>(largest)) + ")";
  return "";
}

std::string model_text(const Computed& computed) {
  const Settings& s = computed.settings;
  if (computed.draft)
    return fmt::format("{}  draft: kernel {} on levels {}..{}", s.model, s.kernel, s.first_level,
                       s.last_level);
  return needs_depth(s.model) ? fmt::format("{}  kernel {}", s.model, s.kernel) : s.model;
}

// The title above the picture; only A or B where there is no room. Below it the error.
void draw_title(const ViewContext& view, const Computed& computed, const PictureSide& side) {
  const float pad = view.px(8), room = side.clip_high.x - side.clip_low.x - 2 * pad;
  std::string text = picture_title(view, side.is_b);
  if (chip_size(view, text).x > room)
    text = shows_difference(view) ? "A − B" : !view.state.comparing() ? "" : side.is_b ? "B" : "A";
  const float width = chip_size(view, text).x;
  const float y = side.clip_low.y - side.strip + view.px(4);
  const bool at_right = side.is_b && view.state.comparison == Comparison::split;
  if (!text.empty() && width <= room)
    draw_chip(view, {at_right ? side.clip_high.x - pad - width : side.clip_low.x + pad, y}, text,
              view.colours->on_picture);
  const std::string note = remark(view, computed);
  if (const float beside = chip_size(view, note).x;
      !note.empty() && !at_right && width + beside + pad <= room)
    draw_chip(view, {side.clip_low.x + 2 * pad + width, y}, note, colours_of(Theme::dark).warning);
  if (!computed.error.empty() && room > view.px(60))
    draw_chip(view, {side.clip_low.x + pad, side.clip_low.y + pad}, computed.error,
              colours_of(Theme::dark).error, room);
}

struct Legend {
  std::string low, high;                          // the values at its ends
  std::function<cv::Vec3b(double share)> colour;  // BGR
  const char* explanation;
  std::optional<double> pointed = std::nullopt;  // the place of the pixel under the mouse, 0..1
};

// The tick of the pixel under the mouse.
void draw_tick(ImDrawList& draw, ImVec2 at, float half, float width) {
  draw.AddLine({at.x, at.y - half}, {at.x, at.y + half}, IM_COL32(0, 0, 0, 255), 3 * width);
  draw.AddLine({at.x, at.y - half}, {at.x, at.y + half}, IM_COL32(255, 255, 255, 255), width);
}

// Returns its width; draws nothing and returns 0 where there is no room.
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
  if (legend.pointed)
    draw_tick(draw, {x + width * static_cast<float>(std::clamp(*legend.pointed, 0.0, 1.0)), y}, 0.8F * bar,
              view.px(1));
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(corner, right_bottom))
    show_tool_tip(legend.explanation);
  return texts + width;
}

// Where a value is in a range; none if that is empty.
std::optional<double> share_of(float value, const ValueRange& range) {
  if (!(range.high > range.low)) return std::nullopt;
  return static_cast<double>((value - range.low) / (range.high - range.low));
}

// The pixel whose values are shown: the pinned one, or the one under the mouse; none if it is on the other
// picture.
std::optional<cv::Point> pointed_pixel(const ViewContext& view, const PictureSide& side) {
  const std::optional<cv::Point> pixel = view.pinned ? view.pinned : view.pointer;
  const bool on_b = view.pinned ? view.pinned_on_b : view.pointer_on_b;
  const bool inside = pixel && cv::Rect({}, view.result->frame().size()).contains(*pixel);
  return inside && on_b == side.is_b ? pixel : std::nullopt;
}

Legend map_legend(const Computed& computed, const MapStyle& style, std::optional<cv::Point> pixel) {
  const ValueRange range = shown_range(computed.smooth, style);
  Legend legend{
      "local mean of saliency " + saliency_text(range.low), saliency_text(range.high),
      [&style](double share) {
        // As on the picture, the strength is the square root of the place in the range.
        return colours_of(style.palette)[static_cast<std::size_t>(255 * std::sqrt(share))];
      },
      "The colours show the mean of the saliency around each pixel, since its peaks are only a few pixels "
      "wide; the mean is lower than they are. All other numbers called saliency are values of the map "
      "itself, as in the files. The tick is the pixel under the mouse"};
  if (pixel && computed.smooth.size() == computed.result.maps.master.size())
    legend.pointed = share_of(computed.smooth(*pixel), range);
  return legend;
}

Legend difference_legend(const ViewResult& result) {
  const float largest = map_difference(result.a.smooth, result.b.smooth).largest;
  return {"B stronger by " + saliency_text(largest), "A by " + saliency_text(largest),
          [](double share) { return difference_colour(2 * share - 1); },
          "The difference of the maps A and B, both as the mean around each pixel"};
}

// The legends, from the right end of the strip below the picture; returns the width that they leave.
float draw_legends(const ViewContext& view, const Computed& computed, const PictureSide& side,
                   std::optional<ValueRange> depth_range) {
  const float pad = view.px(8);
  float room = side.clip_high.x - side.clip_low.x - 2 * pad;
  const float bottom = side.clip_high.y + side.strip - view.px(3);
  const auto add = [&](const Legend& legend) {
    const float width = draw_legend(view, legend, {side.clip_low.x + pad + room, bottom}, room);
    if (width > 0) room -= width + pad;
  };
  const MapStyle style = shown_map_style(view.state, *view.result);
  const std::optional<cv::Point> pixel = pointed_pixel(view, side);
  if (view.state.show_map && shows_difference(view))
    add(difference_legend(*view.result));
  else if (view.state.show_map && computed.error.empty())
    add(map_legend(computed, style, pixel));
  if (!depth_range) return room;
  Legend depth{fmt::format("{:.0f} mm", depth_range->low), fmt::format("{:.0f} mm", depth_range->high),
               [&](double share) { return depth_colour(view.state.style.depth.palette, share); },
               "Depth along the camera's axis; black has no reading. The tick is the pixel under the mouse"};
  const float at_pixel = pixel ? view.result->frame().depth_mm(*pixel) : 0;
  if (at_pixel > 0) depth.pointed = share_of(at_pixel, *depth_range);
  add(depth);
  return room;
}

// The values at the pinned pixel, or under the mouse, in the strip below the picture; as many as there is
// room for.
void draw_pointer(const ViewContext& view, const Computed& computed, const PictureSide& side, float room) {
  const std::optional<cv::Point> pixel = pointed_pixel(view, side);
  const cv::Mat1f& map = computed.result.maps.master;
  if (!pixel || map.size() != view.result->frame().size()) return;
  const cv::Point p = *pixel;
  const float depth = view.result->frame().depth_mm(p);
  for (const std::string& text : pixel_texts(p, depth, map(p))) {
    const ImVec2 size = chip_size(view, text);
    if (size.x > room) continue;
    const ImVec2 corner{side.clip_low.x + view.px(8), side.clip_high.y + side.strip - view.px(3) - size.y};
    return draw_chip(view, corner, text, view.colours->on_picture);
  }
}

// A cross at the pinned pixel.
void draw_pin(const ViewContext& view, const PictureSide& side, const PictureView& picture) {
  if (!view.pinned || view.pinned_on_b != side.is_b) return;
  const cv::Point2d at = picture.to_panel({view.pinned->x + 0.5, view.pinned->y + 0.5});
  const float x = side.corner.x + static_cast<float>(at.x), y = side.corner.y + static_cast<float>(at.y);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (const auto& [colour, width] : {std::pair(IM_COL32(0, 0, 0, 200), 3.5), {view.colours->accent, 1.5}}) {
    draw.AddLine({x - view.px(11), y}, {x - view.px(4), y}, colour, view.px(width));
    draw.AddLine({x + view.px(4), y}, {x + view.px(11), y}, colour, view.px(width));
    draw.AddLine({x, y - view.px(11)}, {x, y - view.px(4)}, colour, view.px(width));
    draw.AddLine({x, y + view.px(4)}, {x, y + view.px(11)}, colour, view.px(width));
  }
}

// The distance between the pinned pixel and a second one, in space.
void draw_distance(const ViewContext& view, const PictureSide& side, const PictureView& picture) {
  if (!view.pinned || !view.measured || view.pinned_on_b != side.is_b) return;
  const auto on_screen = [&](cv::Point pixel) {
    const cv::Point2d at = picture.to_panel({pixel.x + 0.5, pixel.y + 0.5});
    return ImVec2(side.corner.x + static_cast<float>(at.x), side.corner.y + static_cast<float>(at.y));
  };
  const ImVec2 from = on_screen(*view.pinned), to = on_screen(*view.measured);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddLine(from, to, IM_COL32(0, 0, 0, 200), view.px(3.5));
  draw.AddLine(from, to, view.colours->accent, view.px(1.5));
  const auto a = view.point_at(view.pinned), b = view.point_at(view.measured);
  draw_chip(view, {(from.x + to.x) / 2, (from.y + to.y) / 2},
            a && b ? fmt::format("{:.0f} mm", cv::norm(*a - *b)) : "no depth at one end",
            view.colours->on_picture);
}

// Rings around the locked fixation and the one under the mouse, in picture or table.
void draw_rings(const ViewContext& view, const PictureSide& side, const OverlayShapes& shapes) {
  if (side.is_b) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (const int index : {view.hovered_row, view.hovered_mark, view.locked}) {
    if (index < 0 || index >= static_cast<int>(shapes.marks.size())) continue;
    const auto& mark = shapes.marks[shapes.marks.size() - 1 - static_cast<std::size_t>(index)];
    const ImVec2 centre{side.corner.x + mark.centre.x, side.corner.y + mark.centre.y};
    draw.AddCircle(centre, mark.radius + view.px(3), view.colours->accent, 0,
                   view.px(index == view.locked ? 3 : 1.5));
  }
}

}  // namespace

std::string picture_title(const ViewContext& view, bool is_b) {
  const ViewResult& result = *view.result;
  if (shows_difference(view))
    return fmt::format("A − B   {} − {}", model_text(result.a), model_text(result.b));
  const std::string text = model_text(is_b ? result.b : result.a);
  return view.state.comparing() ? fmt::format("{}  {}", is_b ? "B" : "A", text) : text;
}

std::array<std::string, 3> pixel_texts(cv::Point pixel, float depth_mm, float saliency) {
  const std::string mm = depth_mm > 0 ? fmt::format("{:.0f} mm", depth_mm) : "no depth";
  const std::string value = "saliency " + saliency_text(saliency);
  return {fmt::format("row {}  col {}   {}   {}", pixel.y, pixel.x, mm, value),
          fmt::format("{}   {}", mm, value), value};
}

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
  draw_rings(view, side, shapes);
  draw_pin(view, side, picture);
  draw_distance(view, side, picture);
  draw.PopClipRect();
  draw.PushClipRect({side.clip_low.x, side.clip_low.y - side.strip},
                    {side.clip_high.x, side.clip_high.y + side.strip}, false);
  draw_title(view, computed, side);
  draw_pointer(view, computed, side, draw_legends(view, computed, side, depth_range));
  draw.PopClipRect();
  if (!view.pointer || view.pointer_on_b != side.is_b || ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const int mark = mark_under(shapes, as_point({mouse.x - side.corner.x, mouse.y - side.corner.y}));
  if (mark < 0) return;
  view.hovered_mark = fixation_of_a(*view.result, mark, side.is_b);
  explain_fixation(computed, mark, view.hovered_mark >= 0);
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
