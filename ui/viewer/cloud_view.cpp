#include "ui/viewer/cloud_view.hpp"

#include "ui/viewer/panels.hpp"

namespace saccade {

void CloudView::draw(ViewContext& view) {
  if (!view.result) return;
  CloudChoices& choices = view.state.cloud;
  view.wants.normals = choices.lit || choices.needles;
  const Computed& computed = view.result->a;
  if (!scene_) scene_ = std::make_unique<CloudScene>();
  const CloudFrame frame{view.result->frame(), computed.smooth, computed.result.maps.normals,
                         view.state.style, view.result->serial};
  draw_cloud_panel(choices, state_, view.result->frame(), computed.result.attention, [&](cv::Size size) {
    const unsigned texture =
        scene_->render(frame, choices, state_.camera, size, view.state.theme == Theme::light);
    const auto id = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
    if (scene_->renewed()) view.renewed.push_back(id);
    return id;
  });
}

}  // namespace saccade
