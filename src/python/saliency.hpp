#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "attention/attention.hpp"
#include "models/model.hpp"
#include "settings/settings.hpp"

namespace saccade::python {

/// The results for one frame, with memory of their own.
struct FrameResult {
  SaliencyMaps maps;
  Attention attention;
};

/// A model and a selector, as `saccade run` uses them: the same settings give the same bits. Any thread may
/// call compute(); calls wait for one another.
class Saliency {
 public:
  /// Throws Error (usage) if this machine cannot run the model.
  explicit Saliency(const Settings& settings);

  /// `has_depth`: false for a frame of a plain camera. Throws Error as SaliencyModel::compute(), and (usage)
  /// if the levels do not fit the image or the model needs depth that is not there.
  [[nodiscard]] FrameResult compute(const Frame& frame, bool has_depth, RequestedOutputs outputs);

 private:
  void prepare(cv::Size size, bool has_depth);

  std::mutex mutex_;
  Settings settings_;
  WorkerPool pool_;
  std::unique_ptr<SaliencyModel> model_;
  std::unique_ptr<AttentionSelector> selector_;
  cv::Size size_{};  // that model and selector were made for
  bool has_depth_ = true;
};

}  // namespace saccade::python
