#include "python/saliency.hpp"

#include <unistd.h>

#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade::python {
namespace {

constexpr std::int64_t kFrame_us = 33'333;  // between images without a time

}  // namespace

Saliency::Saliency(const Settings& settings, RequestedOutputs outputs)
    : process_(::getpid()), settings_(settings), outputs_(outputs) {
  WorkerPool pool(1);
  (void)make_model(settings, pool);  // so that a model which this machine cannot run is reported here
}

Saliency::~Saliency() {
  if (::getpid() != process_) (void)processor_.release();  // it would wait for threads that are not there
}

void Saliency::check_process() const {
  if (::getpid() != process_)
    throw usage_error("this Saliency was made before the process forked", "",
                      "make one in each process, or start processes with the method spawn");
}

void Saliency::prepare(cv::Size size, const FrameOrigin& origin) {
  if (processor_ && size == size_ && origin.has_depth == origin_.has_depth &&
      origin.sequence == origin_.sequence)
    return;
  processor_.reset();
  Settings settings = settings_;
  if (!origin.has_depth && needs_depth(settings.model))
    throw usage_error(fmt::format("model {} needs depth, and there is none", settings.model), "",
                      fmt::format("choose a model of the image: {}", fmt::join(model_names(false), ", ")));
  if (!origin.has_depth) settings.selector = Selector::wta;  // proto needs depth
  settings.last_level = last_level_for(settings, size);
  check_model(settings, size);
  ProcessorOptions options{settings, settings, {}, outputs_, worker_count(settings)};
  if (tracks(settings, settings.selector, origin.sequence, "")) options.tracking = settings;
  processor_ = make_processor(options);
  size_ = size;
  origin_ = origin;
}

FrameResult Saliency::compute(Frame frame, const FrameOrigin& origin) {
  check_process();
  const std::lock_guard lock(mutex_);
  prepare(frame.size(), origin);
  Result result;
  result.frame = std::move(frame);
  if (result.frame.index < 0) result.frame.index = next_index_;
  if (result.frame.timestamp_us < 0) result.frame.timestamp_us = result.frame.index * kFrame_us;
  next_index_ = result.frame.index + 1;
  processor_->process(result);
  return {std::move(result.maps), std::move(result.attention)};
}

void Saliency::reset() {
  check_process();
  const std::lock_guard lock(mutex_);
  processor_.reset();
  next_index_ = 0;
}

}  // namespace saccade::python
