#include "models/combined.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "models/image.hpp"
#include "models/itti.hpp"
#include "models/symmetry2d.hpp"

namespace saccade {
namespace {

constexpr int kReducedLevel = 2;  // 1/4 of the image

void divide_by_maximum(cv::Mat1f& map) {
  const float maximum = *std::max_element(map.begin(), map.end());
  if (maximum > 0) map *= 1 / maximum;
}

}  // namespace

CombinedModel::CombinedModel(const ModelSettings& settings, WorkerPool& pool)
    : pool_(pool),
      first_level_(settings.first_level),
      symmetry3d_(settings, pool, settings.simd),
      itti_(std::make_unique<IttiModel>("combined", false, pool)),
      symmetry2d_(make_symmetry2d(pool)) {}

// From the coarsest level down: sums_[l] holds the sum of the weighted levels from l on.
void CombinedModel::weigh_levels(const cv::Mat1f& depth_mm) {
  constexpr float kNoiseLimitMm = 500;
  const int last_level = first_level_ + static_cast<int>(maps3d_.levels.size()) - 1;
  sums_.resize(static_cast<std::size_t>(last_level) + 1);
  for (int l = last_level; l >= 0; --l) {
    cv::Mat1f& sum = sums_[static_cast<std::size_t>(l)];
    sum.create(level_size(depth_mm.size(), l));
    const float limit_mm = kNoiseLimitMm * static_cast<float>(1 << l);
    for_row_bands(pool_, sum.rows, [&](int begin, int end) {
      if (l == last_level)
        sum.rowRange(begin, end).setTo(0);
      else
        upsample_rows(sums_[static_cast<std::size_t>(l) + 1], 1, sum, false, begin, end);
      if (l < first_level_) return;
      const cv::Mat1f& score = maps3d_.levels[static_cast<std::size_t>(l - first_level_)];
      for (int r = begin; r < end; ++r)
        for (int c = 0; c < sum.cols; ++c) {
          const float x = depth_mm(r << l, c << l) / limit_mm;
          sum(r, c) += score(r, c) / (1 + x * x);
        }
    });
  }
}

void CombinedModel::reduce(const cv::Mat1f& map, cv::Mat1f& reduced) {
  constexpr double kSigmaPx = 6.0 / (1 << kReducedLevel);
  cv::pyrDown(map, half_);
  cv::pyrDown(half_, reduced);
  cv::GaussianBlur(reduced, reduced, {}, kSigmaPx);
  divide_by_maximum(reduced);
}

// Median of every 16th pixel.
float CombinedModel::trust_in_3d(const cv::Mat1f& depth_mm) {
  constexpr float kNearMm = 1000;
  constexpr int kStep = 1 << kReducedLevel;
  depths_.clear();
  for (int r = 0; r < depth_mm.rows; r += kStep)
    for (int c = 0; c < depth_mm.cols; c += kStep)
      if (depth_mm(r, c) > 0) depths_.push_back(depth_mm(r, c));
  if (depths_.empty()) return 0;
  const auto median = depths_.begin() + static_cast<std::ptrdiff_t>(depths_.size() / 2);
  std::nth_element(depths_.begin(), median, depths_.end());
  const float x = *median / kNearMm;
  return 1 / (1 + (x * x) * (x * x));
}

void CombinedModel::compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps,
                            StageTimes& times) {
  itti_->compute(frame, {}, maps_itti_, times);
  symmetry2d_->compute(frame, {}, maps2d_, times);
  symmetry3d_.compute(frame.depth_mm, frame.intrinsics, {.levels = true, .normals = outputs.normals}, maps3d_,
                      times);
  const StageTimer timer(times, Stage::master_map);
  weigh_levels(frame.depth_mm);
  reduce(sums_[0], reduced3d_);
  reduce(maps_itti_.master, reduced_itti_);
  reduce(maps2d_.master, reduced2d_);
  const float trust = trust_in_3d(frame.depth_mm);
  reduced3d_ *= 0.5F + 0.5F * trust;
  cv::scaleAdd(reduced_itti_, 1 - trust, reduced3d_, reduced3d_);
  cv::scaleAdd(reduced2d_, (1 - trust) / 4, reduced3d_, reduced3d_);
  maps.master.create(frame.size());
  for_row_bands(pool_, frame.size().height, [&](int begin, int end) {
    upsample_rows(reduced3d_, kReducedLevel, maps.master, false, begin, end);
  });
  maps.levels.resize(outputs.levels ? maps3d_.levels.size() : 0);
  for (std::size_t i = 0; i < maps.levels.size(); ++i) maps3d_.levels[i].copyTo(maps.levels[i]);
  if (outputs.normals)
    maps3d_.normals.copyTo(maps.normals);
  else
    maps.normals.release();
}

}  // namespace saccade
