#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "models/model.hpp"
#include "ui/viewer/panels.hpp"
#include "ui/viewer/texture.hpp"
#include "ui/viewer/widgets.hpp"

namespace saccade {
namespace {

constexpr double kZoomStep = 1.15, kSharpFrom = 3;

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

// A line of text on a dark ground; returns its size.
ImVec2 draw_chip(const ViewContext& view, ImVec2 corner, const std::string& text, unsigned colour) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pad{view.px(7), view.px(3)};
  draw.AddRectFilled(corner, {corner.x + size.x + 2 * pad.x, corner.y + size.y + 2 * pad.y},
                     view.colours->chip, view.px(5));
  draw.AddText({corner.x + pad.x, corner.y + pad.y}, colour, text.c_str());
  return {size.x + 2 * pad.x, size.y + 2 * pad.y};
}

std::string title_of(const Computed& computed, const char* side) {
  const Settings& s = computed.settings;
  std::string title = fmt::format("{}{}", side, s.model);
  if (computed.draft)
    title += fmt::format("  draft: k {} on levels {}..{}", s.kernel, s.first_level, s.last_level);
  else if (needs_depth(s.model))
    title += fmt::format("  k {}", s.kernel);
  return title;
}

// The palette with the values at its ends.
void draw_legend(const ViewContext& view, const Computed& computed, ImVec2 right_bottom) {
  const MapStyle& style = view.state.style.map;
  const ValueRange range = shown_range(computed.smooth, style);
  const std::string low = fmt::format("{:.2g}", range.low), high = fmt::format("{:.2g}", range.high);
  const ImVec2 text = ImGui::CalcTextSize(high.c_str());
  const float width = view.px(96), bar = view.px(8), pad = view.px(6);
  const float low_width = ImGui::CalcTextSize(low.c_str()).x;
  const float whole = low_width + width + text.x + 4 * pad, height = text.y + view.px(6);
  const ImVec2 corner{right_bottom.x - whole, right_bottom.y - height};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, right_bottom, view.colours->chip, view.px(5));
  const float y = corner.y + height / 2, x = corner.x + 2 * pad + low_width;
  draw.AddText({corner.x + pad, y - text.y / 2}, view.colours->on_picture, low.c_str());
  draw.AddText({x + width + pad, y - text.y / 2}, view.colours->on_picture, high.c_str());
  constexpr int kPieces = 32;
  for (int i = 0; i < kPieces; ++i) {
    // The strength is the root of the place in the range: as on the picture.
    const double place = (i + 0.5) / kPieces;
    const auto& c = colours_of(style.palette)[static_cast<std::size_t>(255 * std::sqrt(place))];
    const float x0 = x + width * static_cast<float>(i) / kPieces;
    draw.AddRectFilled({x0, y - bar / 2}, {x0 + width / kPieces + 0.5F, y + bar / 2},
                       IM_COL32(c[2], c[1], c[0], 255));
  }
}

}  // namespace

// What is on the graphics card, and of what it was made. The map is laid over the frame here and not by the
// graphics card, which would go over each pixel of the window twice: where it is the processor, that is felt.
struct PicturePanel::Layers {
  struct Side {
    Texture texture;
    std::int64_t serial = 0;
    bool map = false;
    OverlayStyle style;
  };
  cv::Mat3b background;
  std::optional<std::int64_t> index;  // of the background's frame
  std::int64_t timestamp_us = 0;
  Background background_style = Background::colour;
  DepthStyle depth_style;
  Side a, b;
  PictureView view;
  bool dragging = false, dragging_divider = false;

  void update_background(const ViewResult& result, const OverlayStyle& style) {
    const Frame& frame = result.frame();  // the same one comes again when only the settings change
    if (index == frame.index && timestamp_us == frame.timestamp_us && background_style == style.background &&
        depth_style == style.depth)
      return;
    background = draw_background(frame, style);
    index = frame.index;
    timestamp_us = frame.timestamp_us;
    background_style = style.background;
    depth_style = style.depth;
  }

  void update(Side& side, const Computed& computed, ViewContext& context) const {
    const ViewState& state = context.state;
    const OverlayStyle& style = state.style;
    const std::int64_t serial = context.result->serial;
    if (side.serial == serial && side.map == state.show_map && side.style.map == style.map &&
        side.style.background == style.background && side.style.depth == style.depth)
      return;
    cv::Mat3b picture = background;
    if (state.show_map) {
      picture = background.clone();
      blend_map(picture, shown_strength(computed.smooth, style.map), style.map);
    }
    side.texture.upload(picture);
    side.serial = serial;
    side.map = state.show_map;
    side.style = style;
    context.renewed.push_back(side.texture.id());
  }
};

// One picture on the screen.
struct PicturePanel::Place {
  ImVec2 corner, size;         // of the part of the window that the picture's coordinates refer to
  ImVec2 clip_low, clip_high;  // of what is seen of it
  bool is_b;
};

PicturePanel::PicturePanel() : layers_(std::make_unique<Layers>()) {}
PicturePanel::~PicturePanel() = default;

void PicturePanel::fit() { layers_->view.fit(); }

void PicturePanel::forget() {
  layers_->view.fit();
  layers_->index.reset();
}

void PicturePanel::draw(ViewContext& view) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  view.places["picture"] = {corner.x, corner.y, corner.x + size.x, corner.y + size.y};
  view.pointer.reset();
  if (size.x < 8 || size.y < 8) return;
  ImGui::InvisibleButton("##picture", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  const ImVec2 end{corner.x + size.x, corner.y + size.y};
  if (!view.result) {
    const char* text = view.source.phase == SessionState::Phase::ended
                           ? "Nothing to show. Open a source, or drop a file or folder here."
                           : "Waiting for the first frame…";
    const ImVec2 extent = ImGui::CalcTextSize(text);
    ImGui::GetWindowDrawList()->AddText(
        {corner.x + (size.x - extent.x) / 2, corner.y + (size.y - extent.y) / 2}, view.colours->dim_text,
        text);
    return;
  }
  Layers& l = *layers_;
  l.update_background(*view.result, view.state.style);
  l.update(l.a, view.result->a, view);
  const bool two = view.state.comparing() && view.result->compared;
  if (two) l.update(l.b, view.result->b, view);

  if (two && view.state.comparison == Comparison::side_by_side) {
    const float gap = view.px(4), half = (size.x - gap) / 2;
    const Place a{corner, {half, size.y}, corner, {corner.x + half, end.y}, false};
    const ImVec2 corner_b{corner.x + half + gap, corner.y};
    const Place b{corner_b, {half, size.y}, corner_b, end, true};
    handle_mouse(view, ImGui::GetIO().MousePos.x < corner_b.x ? a : b);
    draw_side(view, a);
    draw_side(view, b);
  } else if (two) {
    const float x = corner.x + size.x * static_cast<float>(view.state.divider);
    const Place a{corner, size, corner, {x, end.y}, false}, b{corner, size, {x, corner.y}, end, true};
    handle_mouse(view, ImGui::GetIO().MousePos.x < x ? a : b);
    draw_side(view, a);
    draw_side(view, b);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddLine({x, corner.y}, {x, end.y}, IM_COL32(0, 0, 0, 160), view.px(4));
    draw.AddLine({x, corner.y}, {x, end.y}, view.colours->on_picture, view.px(1.5));
    draw.AddCircleFilled({x, corner.y + size.y / 2}, view.px(7), view.colours->on_picture);
    view.places["divider"] = {x - view.px(5), corner.y, x + view.px(5), end.y};
  } else {
    const Place a{corner, size, corner, end, false};
    handle_mouse(view, a);
    draw_side(view, a);
  }
}

void PicturePanel::handle_mouse(ViewContext& view, const Place& place) {
  Layers& l = *layers_;
  const ImGuiIO& io = ImGui::GetIO();
  const cv::Size frame = view.result->frame().size();
  l.view.layout({static_cast<double>(place.size.x), static_cast<double>(place.size.y)}, frame);
  const bool hovered = ImGui::IsItemHovered();
  const cv::Point2d at = as_point({io.MousePos.x - place.corner.x, io.MousePos.y - place.corner.y});
  const bool split = view.state.comparison == Comparison::split && view.result->compared;
  const double divider_x = static_cast<double>(place.size.x) * view.state.divider;
  const bool near_divider = split && hovered && std::abs(at.x - divider_x) < 6 * view.unit;
  if (near_divider || l.dragging_divider) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);

  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    l.dragging_divider = near_divider;
    l.dragging = !near_divider;
  }
  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) l.dragging = true;
  if (!ImGui::IsItemActive()) l.dragging = l.dragging_divider = false;
  if (l.dragging_divider)
    view.state.divider = std::clamp(at.x / static_cast<double>(place.size.x), 0.02, 0.98);
  if (l.dragging && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) l.view.pan(as_point(io.MouseDelta));
  if (hovered && io.MouseWheel != 0) l.view.zoom(std::pow(kZoomStep, static_cast<double>(io.MouseWheel)), at);
  if (hovered && !near_divider && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) l.view.fit();

  if (!hovered || l.dragging_divider) return;
  const cv::Point2d pixel = l.view.to_picture(at);
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame.width || pixel.y >= frame.height) return;
  view.pointer = cv::Point(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  view.pointer_on_b = place.is_b;
}

void PicturePanel::draw_side(ViewContext& view, const Place& place) {
  Layers& l = *layers_;
  const Computed& computed = place.is_b ? view.result->b : view.result->a;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(place.clip_low, place.clip_high, true);
  const cv::Size frame = view.result->frame().size();
  const auto on_screen = [&](cv::Point2d picture) {
    const cv::Point2d p = l.view.to_panel(picture);
    return ImVec2(place.corner.x + static_cast<float>(p.x), place.corner.y + static_cast<float>(p.y));
  };
  const ImVec2 low = on_screen({0, 0}), high = on_screen(cv::Point2d(frame.width, frame.height));
  Texture& texture = (place.is_b ? l.b : l.a).texture;
  if (texture.set_sharp(l.view.scale() >= kSharpFrom)) view.renewed.push_back(texture.id());
  draw.AddImage(texture.id(), low, high);
  draw_shapes(draw, overlay_shapes(computed, view.state.style, l.view, view.unit), place.corner);
  if (view.over_picture)
    view.over_picture(
        draw, {on_screen({0, 0}), place.clip_low, place.clip_high, static_cast<float>(l.view.scale())});

  const float pad = view.px(8);
  const std::string title = title_of(computed, view.state.comparing() ? (place.is_b ? "B  " : "A  ") : "");
  const float width = ImGui::CalcTextSize(title.c_str()).x + view.px(14);
  const bool at_right = place.is_b && view.state.comparison == Comparison::split;
  draw_chip(view,
            {at_right ? place.clip_high.x - pad - width : place.clip_low.x + pad, place.clip_low.y + pad},
            title, view.colours->on_picture);
  if (!computed.error.empty())
    draw_chip(view, {place.clip_low.x + pad, place.clip_low.y + pad + ImGui::GetFontSize() * 2},
              computed.error, colours_of(Theme::dark).error);
  else if (view.state.show_map)
    draw_legend(view, computed, {place.clip_high.x - pad, place.clip_high.y - pad});
  if (view.pointer && view.pointer_on_b == place.is_b) {
    const cv::Point p = *view.pointer;
    const float depth = view.result->frame().depth_mm(p);
    draw_chip(
        view, {place.corner.x + pad, place.clip_high.y - pad - ImGui::GetFontSize() - view.px(6)},
        fmt::format("row {}  col {}   {}   saliency {:.2f}", p.y, p.x,
                    depth > 0 ? fmt::format("{:.0f} mm", depth) : "no depth", computed.result.maps.master(p)),
        view.colours->on_picture);
  }
  draw.PopClipRect();
}

}  // namespace saccade
