#include "ui/panels/cloud_panel.hpp"

#include "ui/panels/widgets.hpp"

namespace saccade {

void CloudPanel::draw(ViewContext& view) {
  if (!view.result) return;
  CloudStyle& style = view.state.cloud;
  view.outputs.normals = style.lit || style.needles;
  const Computed& computed = view.result->a;
  if (!picture_) picture_ = view.graphics.make_cloud_picture();
  const CloudFrame frame{view.result->frame(), computed.smooth, computed.result.maps.normals,
                         view.state.style, view.result->serial};
  draw_cloud(style, state_, view.result->frame(), computed.result.attention, [&](cv::Size size) {
    return as_imgui(picture_->render(frame, style, state_.camera, size, view.state.theme == Theme::light));
  });
}

}  // namespace saccade
