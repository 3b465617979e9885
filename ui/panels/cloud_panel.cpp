#include "ui/panels/cloud_panel.hpp"

#include "ui/panels/picture_clicks.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {

void CloudPanel::draw(ViewContext& view) {
  if (!view.result) return;
  CloudStyle& style = view.state.cloud;
  view.outputs.normals = style.lit || style.needles;
  const Computed& computed = view.result->a;
  if (!picture_) picture_ = view.graphics.make_cloud_picture();
  const Frame shown = view.shown_frame();
  const CloudFrame frame{shown, computed.smooth, computed.result.maps.normals, view.state.style,
                         view.result->serial};
  state_.highlighted = view.locked >= 0 ? view.locked : view.hovered_row;
  state_.pinned = view.point_at(view.pinned);
  state_.measured.clear();
  if (const auto a = view.point_at(view.pinned), b = view.point_at(view.measured); a && b)
    state_.measured = {*a, *b};
  if (view.centre_on && view.centre_on->position_mm.z > 0) {
    const cv::Point3f& p = view.centre_on->position_mm;
    state_.camera.look_at({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  }
  state_.title = view.state.comparing() ? "of A" : "";
  draw_cloud(style, state_, shown, computed.result.attention, [&](cv::Size size) {
    return as_imgui(picture_->render(frame, style, state_.camera, size, view.state.theme == Theme::light));
  });
  if (state_.hovered_mark >= 0) {
    view.hovered_mark = state_.hovered_mark;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) explain_fixation(computed, state_.hovered_mark, true);
  }
  if (state_.clicked && state_.hovered_mark >= 0)
    click_mark(view, state_.hovered_mark);
  else if (state_.clicked)
    click_pixel(view, state_.clicked_pixel, false);
}

}  // namespace saccade
