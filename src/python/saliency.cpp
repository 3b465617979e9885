#include "python/saliency.hpp"

#include "core/error.hpp"

namespace saccade::python {

Saliency::Saliency(const Settings& settings)
    : settings_(settings), pool_(worker_count(settings)), model_(make_model(settings, pool_)) {}

void Saliency::prepare(cv::Size size, bool has_depth) {
  if (selector_ && size == size_ && has_depth == has_depth_) return;
  Settings settings = settings_;
  if (!has_depth && needs_depth(settings.model))
    throw usage_error("this model needs depth, and there is none", settings.model,
                      "choose a model of the image");
  if (!has_depth) settings.selector = Selector::wta;  // proto needs depth
  settings.last_level = last_level_for(settings, size);
  check_model(settings, size);
  model_ = make_model(settings, pool_);
  selector_ = make_selector(settings);
  size_ = size;
  has_depth_ = has_depth;
}

FrameResult Saliency::compute(const Frame& frame, bool has_depth, RequestedOutputs outputs) {
  const std::lock_guard lock(mutex_);
  prepare(frame.size(), has_depth);
  FrameResult result;
  StageTimes times;
  model_->compute(frame, outputs, result.maps, times);
  selector_->select(result.maps.master, frame.depth_mm, frame.intrinsics, result.attention);
  return result;
}

}  // namespace saccade::python
