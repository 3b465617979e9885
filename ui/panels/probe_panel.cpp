#include "ui/panels/probe_panel.hpp"

#include <algorithm>
#include <utility>

#include "saliency/params.hpp"
#include "ui/panels/fixation_panel.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

// The settings' parameters, with the levels that the frame has room for; none if it has room for none.
std::optional<Symmetry3dParams> params_for(const Settings& settings, cv::Size size) {
  Symmetry3dParams params = settings;
  params.last_level = std::min(params.last_level, deepest_level(size));
  params.first_level = std::min(params.first_level, params.last_level);
  if (params.last_level < 0) return std::nullopt;
  return params;
}

}  // namespace

// The weights of the levels in the master map. They depend on whole maps, so they are kept while only the
// pixel changes. Empty = all 1.
std::vector<double> ProbePanel::weights_of(const Computed& computed, const Symmetry3dParams& params,
                                           const Source& source) {
  const std::vector<cv::Mat1f>& maps = computed.result.maps.levels;
  const int levels = params.last_level - params.first_level + 1;
  if (params.normalisation == LevelNormalisation::none || std::cmp_not_equal(maps.size(), levels)) return {};
  if (weighed_ && weighed_->serial == source.serial && weighed_->b == source.b) return weights_;
  weights_.clear();
  for (const cv::Mat1f& map : maps) {
    cv::Mat1d exact;
    map.convertTo(exact, CV_64F);
    weights_.push_back(reference::level_weight(exact, params.normalisation));
  }
  weighed_ = source;
  return weights_;
}

void ProbePanel::probe_pixel(const ViewContext& view, const Source& source) {
  const Computed& computed = source.b ? view.result->b : view.result->a;
  const Frame& frame = view.result->frame();
  const auto params = params_for(computed.settings, frame.size());
  shown_.reset();
  source_ = source;
  if (!params) return;
  ProbeShown shown;
  shown.probe = probe(frame.depth_mm, frame.intrinsics, *params, source.pixel.y, source.pixel.x,
                      weights_of(computed, *params, source));
  shown.camera = frame.intrinsics;
  const cv::Mat1f& map = computed.result.maps.master;
  shown.saliency = map.size() == frame.size() ? static_cast<double>(map(source.pixel)) : 0;
  shown.model = computed.settings.model;
  shown.levels_apply = shown.model == "symmetry3d";
  shown_ = std::move(shown);
}

// The object over time that holds the pixel.
void ProbePanel::draw_object(const Computed& computed) const {
  const cv::Mat1w& masks = computed.result.attention.masks;
  if (!computed.marks || !cv::Rect({}, masks.size()).contains(*pixel_) || masks(*pixel_) == 0) return;
  wrapped_text(object_text(computed, masks(*pixel_) - 1));
}

void ProbePanel::draw(ViewContext& view) {
  if (view.pinned) {
    pixel_ = view.pinned;
    on_b_ = view.pinned_on_b;
  } else if (view.pointer) {
    pixel_ = view.pointer;
    on_b_ = view.pointer_on_b;
  }
  wrapped_text(view.pinned ? "Pinned. The arrow keys move it; Shift+click measures a distance from it; a "
                             "click or Esc frees it."
                           : "Follows the mouse. A click on the picture pins it.",
               Tone::quiet);
  const bool inside = view.result && pixel_ && cv::Rect({}, view.result->frame().size()).contains(*pixel_);
  if (!inside) {
    shown_.reset();
    source_.reset();
  } else {
    const Source source{view.result->serial, on_b_ && view.result->compared, *pixel_};
    if (source_ != source) probe_pixel(view, source);
    view.outputs.levels = view.state.settings.a.normalisation != LevelNormalisation::none ||
                          view.state.settings.b.normalisation != LevelNormalisation::none;
  }
  if (inside) draw_object(on_b_ && view.result->compared ? view.result->b : view.result->a);
  draw_probe(shown_, state_);
  if (shown_)
    view.over_picture = [this](ImDrawList& list, const PicturePlace& place) {
      if (shown_) draw_footprints(list, *shown_, state_, place);
    };
}

}  // namespace saccade
