#include "ui/session/model_runner.hpp"

#include <algorithm>
#include <exception>

#include "saliency/params.hpp"

namespace saccade {
namespace {

void copy_maps(const SaliencyMaps& from, SaliencyMaps& to) {
  from.master.copyTo(to.master);
  from.normals.copyTo(to.normals);
  to.levels.resize(from.levels.size());
  for (std::size_t i = 0; i < from.levels.size(); ++i) from.levels[i].copyTo(to.levels[i]);
}

void copy_attention(const Attention& from, Attention& to) {
  from.masks.copyTo(to.masks);
  to.fixations = from.fixations;
  to.ended_early = from.ended_early;
  to.sequence = from.sequence;
}

}  // namespace

bool has_maps(const Computed& of, Settings settings, RequestedOutputs outputs) {
  settings.last_level = last_level_for(settings, of.result.frame.size());
  return of.error.empty() && same_values(SettingScope::model, of.settings, settings) && of.outputs == outputs;
}

void ModelRunner::compute(const Settings& wanted, RequestedOutputs outputs, const Computed* last,
                          Computed& out, const Attend& attend) {
  const Frame& frame = out.result.frame;
  Settings settings = wanted;
  settings.last_level = last_level_for(settings, frame.size());
  out.settings = settings;
  out.outputs = outputs;
  out.error.clear();
  out.marks.reset();
  try {
    prepare(settings, frame.size());
    find_maps(settings, outputs, last, out);
    if (last != nullptr && has_maps(*last, settings, outputs) &&
        last->marks.has_value() == static_cast<bool>(attend) &&
        same_values(SettingScope::attention, last->settings, settings) &&
        (!attend || same_values(SettingScope::tracking, last->settings, settings))) {
      copy_attention(last->result.attention, out.result.attention);
      out.outlines = last->outlines;
      out.marks = last->marks;
      return;
    }
    const StageTimer timer(out.result.times, Stage::attention);
    if (attend)
      attend(out);
    else
      selector_->select(out.result.maps.master, frame.depth_mm, frame.intrinsics, out.result.attention);
  } catch (const std::exception& error) {
    out.error = error.what();
    out.result.maps.master.create(frame.size());
    out.result.maps.master.setTo(0);
    out.result.maps.levels.clear();
    out.result.maps.normals.release();
    out.result.attention = {};
    out.smooth = smooth_for_looking(out.result.maps.master);
  }
  out.outlines = proto_outlines(out.result.attention);
}

void ModelRunner::find_maps(const Settings& settings, RequestedOutputs outputs, const Computed* last,
                            Computed& out) {
  if (last != nullptr && has_maps(*last, settings, outputs)) {
    copy_maps(last->result.maps, out.result.maps);
    last->smooth.copyTo(out.smooth);
    return;
  }
  model_->compute(out.result.frame, outputs, out.result.maps, out.result.times);
  out.smooth = smooth_for_looking(out.result.maps.master);
}

void ModelRunner::prepare(const Settings& settings, cv::Size image) {
  check_model(settings, image);
  if (!model_ || !same_values(SettingScope::model, settings, made_)) model_ = make_model(settings, pool_);
  if (!selector_ || !same_values(SettingScope::attention, settings, made_))
    selector_ = make_selector(settings);
  made_ = settings;
}

std::optional<Settings> draft_of(Settings settings, cv::Size image) {
  // The sweep over the window grows with its area, the rest is as much as 110 points of it.
  constexpr double kMostWork = 640 * 480 * 4.0 / 3 * (21 * 21 + 110), kRest = 110;
  if (!needs_depth(settings.model)) return std::nullopt;
  settings.last_level = last_level_for(settings, image);
  const int deepest = deepest_level(image);
  const auto work = [&] {
    double pixels = 0;
    for (int level = settings.first_level; level <= settings.last_level; ++level)
      pixels += level_size(image, level).area();
    return pixels * (settings.kernel * settings.kernel + kRest);
  };
  bool reduced = false;
  while (work() > kMostWork && settings.first_level < deepest && settings.kernel >= 6) {
    ++settings.first_level;
    settings.last_level = std::min(settings.last_level + 1, deepest);
    settings.kernel /= 2;
    reduced = true;
  }
  settings.levels_chosen = true;
  return reduced ? std::optional(settings) : std::nullopt;
}

}  // namespace saccade
