#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/picture_clicks.hpp"
#include "ui/panels/widgets.hpp"
#include "ui/session/map_difference.hpp"

namespace saccade {
namespace {

constexpr double kZoomStep = 1.15, kSharpFrom = 3;

}  // namespace

// The textures, and the inputs of which they were made. The map is blended over the frame here and not by
// OpenGL, which would draw each pixel of the window twice: slow where software renders.
struct PicturePanel::Layers {
  struct Side {
    std::unique_ptr<PictureTexture> texture;  // made with the first picture
    cv::Mat3b picture;                        // kept for its memory
    std::int64_t serial = 0;
    bool map = false, difference = false;
    OverlayStyle style;
  };
  cv::Mat3b background;
  std::optional<std::int64_t> index;  // of the background's frame
  std::int64_t timestamp_us = 0;
  Background background_style = Background::colour;
  DepthStyle depth_style;
  std::optional<ValueRange> depth_range;  // of the background; none = that does not show depth
  Side a, b;
  PictureView view;
  bool dragging = false, dragging_divider = false;

  void update_background(const ViewContext& context, const OverlayStyle& style) {
    const Frame frame = context.shown_frame();  // stays the same when only the settings change
    if (index == frame.index && timestamp_us == frame.timestamp_us && background_style == style.background &&
        depth_style == style.depth)
      return;
    background = draw_background(frame, style);
    depth_range = shown_depth_range(frame, style);
    index = frame.index;
    timestamp_us = frame.timestamp_us;
    background_style = style.background;
    depth_style = style.depth;
  }

  void update(Side& side, const Computed& computed, ViewContext& context) const {
    const ViewState& state = context.state;
    const ViewResult& result = *context.result;
    OverlayStyle style = state.style;
    style.map = shown_map_style(state, result);
    const bool difference = shows_difference(context);
    const std::int64_t serial = result.serial;
    if (side.serial == serial && side.map == state.show_map && side.difference == difference &&
        side.style.map == style.map && side.style.background == style.background &&
        side.style.depth == style.depth)
      return;
    if (state.show_map) {
      background.copyTo(side.picture);
      if (difference)
        blend_difference(side.picture, map_difference(result.a.smooth, result.b.smooth), style.map.opacity);
      else
        blend_map(side.picture, shown_strength(computed.smooth, style.map), style.map);
    }
    if (!side.texture) side.texture = context.graphics.make_texture();
    side.texture->upload(state.show_map ? side.picture : background);
    side.serial = serial;
    side.map = state.show_map;
    side.difference = difference;
    side.style = style;
  }
};

PicturePanel::PicturePanel() : layers_(std::make_unique<Layers>()) {}
PicturePanel::~PicturePanel() = default;

void PicturePanel::fit() { layers_->view.fit(); }

void PicturePanel::reset() {
  layers_->view.fit();
  layers_->index.reset();
}

void PicturePanel::draw(ViewContext& view) {
  const float strip = ImGui::GetFontSize() + view.px(14);
  ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  corner.y += strip;
  size.y -= 2 * strip;
  view.places["picture"] = {corner.x, corner.y, corner.x + size.x, corner.y + size.y};
  view.pointer.reset();
  view.hovered_mark = -1;
  if (size.x < 8 || size.y < 8) return;
  ImGui::SetCursorScreenPos(corner);
  ImGui::InvisibleButton("##picture", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  const ImVec2 end{corner.x + size.x, corner.y + size.y};
  if (!view.result) return;
  Layers& l = *layers_;
  l.update_background(view, view.state.style);
  l.update(l.a, view.result->a, view);
  const bool two = view.state.comparing() && view.result->compared;
  if (two) l.update(l.b, view.result->b, view);

  if (two && view.state.comparison == Comparison::difference) {
    const PictureSide a{corner, size, corner, end, strip, false};
    handle_mouse(view, a);
    draw_side(view, a);
  } else if (two && view.state.comparison == Comparison::side_by_side) {
    const float gap = view.px(4), half = (size.x - gap) / 2;
    const PictureSide a{corner, {half, size.y}, corner, {corner.x + half, end.y}, strip, false};
    const ImVec2 corner_b{corner.x + half + gap, corner.y};
    const PictureSide b{corner_b, {half, size.y}, corner_b, end, strip, true};
    handle_mouse(view, ImGui::GetIO().MousePos.x < corner_b.x ? a : b);
    draw_side(view, a);
    draw_side(view, b);
  } else if (two) {
    const float x = corner.x + size.x * static_cast<float>(view.state.divider);
    const PictureSide a{corner, size, corner, {x, end.y}, strip, false};
    const PictureSide b{corner, size, {x, corner.y}, end, strip, true};
    handle_mouse(view, ImGui::GetIO().MousePos.x < x ? a : b);
    draw_side(view, a);
    draw_side(view, b);
    draw_divider(view, {corner, size, corner, end, strip, false});
  } else {
    const PictureSide a{corner, size, corner, end, strip, false};
    handle_mouse(view, a);
    draw_side(view, a);
  }
}

void PicturePanel::handle_mouse(ViewContext& view, const PictureSide& side) {
  Layers& l = *layers_;
  const ImGuiIO& io = ImGui::GetIO();
  const cv::Size frame = view.result->frame().size();
  l.view.layout({static_cast<double>(side.size.x), static_cast<double>(side.size.y)}, frame);
  if (view.centre_on) l.view.centre_on({view.centre_on->col + 0.5, view.centre_on->row + 0.5});
  const bool hovered = ImGui::IsItemHovered();
  const cv::Point2d at = as_point({io.MousePos.x - side.corner.x, io.MousePos.y - side.corner.y});
  const bool split = view.state.comparison == Comparison::split && view.result->compared;
  const double divider_x = static_cast<double>(side.size.x) * view.state.divider;
  const bool near_divider = split && hovered && std::abs(at.x - divider_x) < 6 * view.unit;
  if (near_divider || l.dragging_divider) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);

  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    l.dragging_divider = near_divider;
    l.dragging = !near_divider;
  }
  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) l.dragging = true;
  if (!ImGui::IsItemActive()) l.dragging = l.dragging_divider = false;
  if (l.dragging_divider)
    view.state.divider = std::clamp(at.x / static_cast<double>(side.size.x), 0.02, 0.98);
  if (l.dragging && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) l.view.pan(as_point(io.MouseDelta));
  if (hovered && io.MouseWheel != 0) l.view.zoom(std::pow(kZoomStep, static_cast<double>(io.MouseWheel)), at);
  if (hovered && !near_divider && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) l.view.fit();

  if (!hovered || l.dragging_divider) return;
  const cv::Point2d pixel = l.view.to_picture(at);
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame.width || pixel.y >= frame.height) return;
  view.pointer = cv::Point(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  view.pointer_on_b = side.is_b;
  const float travelled =
      std::hypot(io.MouseClickedPos[0].x - io.MousePos.x, io.MouseClickedPos[0].y - io.MousePos.y);
  if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && travelled < view.px(4)) click(view, side);
}

void PicturePanel::click(ViewContext& view, const PictureSide& side) {
  const Computed& computed = side.is_b ? view.result->b : view.result->a;
  const OverlayShapes shapes = overlay_shapes(computed, view.state.style, layers_->view, view.unit);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const int mark = mark_under(shapes, as_point({mouse.x - side.corner.x, mouse.y - side.corner.y}));
  if (const int locked = mark < 0 ? -1 : fixation_of_a(*view.result, mark, side.is_b); locked >= 0)
    click_mark(view, locked);
  else
    click_pixel(view, view.pointer, side.is_b);
}

void PicturePanel::draw_side(ViewContext& view, const PictureSide& side) {
  Layers& l = *layers_;
  const cv::Size frame = view.result->frame().size();
  const auto on_screen = [&](cv::Point2d picture) {
    const cv::Point2d p = l.view.to_panel(picture);
    return ImVec2(side.corner.x + static_cast<float>(p.x), side.corner.y + static_cast<float>(p.y));
  };
  const ImVec2 low = on_screen({0, 0}), high = on_screen(cv::Point2d(frame.width, frame.height));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(side.clip_low, side.clip_high, true);
  PictureTexture& texture = *(side.is_b ? l.b : l.a).texture;
  texture.set_sharp(l.view.scale() >= kSharpFrom);
  draw.AddImage(as_imgui(texture.id()), low, high);
  draw.PopClipRect();
  draw_over_picture(view, side, l.view, l.depth_range);
}

}  // namespace saccade
