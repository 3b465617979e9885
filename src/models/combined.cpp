#include "models/combined.hpp"

#include <opencv2/imgproc.hpp>

#include "models/image.hpp"
#include "models/symmetry2d.hpp"

namespace saccade {
namespace {

constexpr int kReducedLevel = 2;        // 1/4 of the image
constexpr int kLevelsOfSymmetry2d = 4;  // 2 to 5 of the image, which are 1 to 4 of the halved one

void divide_by_maximum(cv::Mat1f& map) {
  double maximum = 0;
  cv::minMaxLoc(map, nullptr, &maximum);
  if (maximum > 0) map *= 1 / static_cast<float>(maximum);
}

}  // namespace

CombinedModel::CombinedModel(const ModelSettings& settings, WorkerPool& pool)
    : pool_(pool),
      first_level_(settings.first_level),
      symmetry3d_(settings, pool, settings.simd),
      itti_("combined", false, pool, 1),
      symmetry2d_(make_symmetry2d(pool, kLevelsOfSymmetry2d)) {}

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
      const float scale = 1 / limit_mm;
      for (int r = begin; r < end; ++r) {
        const float *depth = depth_mm[r << l], *of_level = score[r];
        float* out = sum[r];
        const auto add = [&](int c, float z) { out[c] += of_level[c] / (1 + (z * scale) * (z * scale)); };
        if (l == 0)  // apart, since the compiler vectorises it
          for (int c = 0; c < sum.cols; ++c) add(c, depth[c]);
        else
          for (int c = 0; c < sum.cols; ++c) add(c, depth[c << l]);
      }
    });
  }
}

// The maps at 1/4 of the image; those of the image have never been larger. `itti` is of level
// itti_.map_level() of the halved image.
void CombinedModel::reduce(const cv::Mat1f& itti, const cv::Mat1f& symmetry2d) {
  constexpr double kSigmaPx = 6.0 / (1 << kReducedLevel);
  static_assert(1 + MirrorPairModel::kFirstLevel == kReducedLevel);
  const auto reduce_one = [&](int i, int) {
    cv::Mat1f& reduced = i == 0 ? reduced3d_ : i == 1 ? reduced2d_ : reduced_itti_;
    const cv::Mat1f& sharp = i == 1 ? symmetry2d : reduced;
    if (i == 0) {
      cv::pyrDown(sums_[0], half_);
      cv::pyrDown(half_, reduced);
    } else if (i == 2) {
      reduced.create(symmetry2d.size());
      upsample_rows(itti, 1 + itti_.map_level() - kReducedLevel, reduced, false, 0, reduced.rows);
    }
    cv::GaussianBlur(sharp, reduced, {}, kSigmaPx);
    divide_by_maximum(reduced);
  };
  pool_.for_each(3, std::ref(reduce_one));
}

// reduced3d_ becomes the combined map at 1/4 of the image.
void CombinedModel::combine() {
  constexpr float kWeightOf2d = 0.25F, kWeightOf3d = 0.5F, kFlat = 0.35F, kEvidence = 0.002F;
  cv::scaleAdd(reduced2d_, kWeightOf2d, reduced_itti_, reduced_itti_);
  divide_by_maximum(reduced_itti_);
  for_row_bands(pool_, reduced3d_.rows, [&](int begin, int end) {
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < reduced3d_.cols; ++c) {
        const float image = reduced_itti_(r, c), evidence = reduced3d_(r, c);
        const float either = 1 - (1 - kWeightOf3d * evidence) * (1 - image);
        reduced3d_(r, c) = either * (kFlat + (1 - kFlat) * evidence / (evidence + kEvidence));
      }
  });
}

void CombinedModel::compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps,
                            StageTimes& times) {
  cv::Mat1f itti, symmetry2d;  // headers of the models' own maps
  {
    const StageTimer timer(times, Stage::symmetry);
    cv::pyrDown(colour_of(frame, "combined"), half_colour_);
    itti = itti_.find_conspicuity(half_colour_);
    symmetry2d = symmetry2d_->find_symmetry(half_colour_);
  }
  symmetry3d_.compute_levels(frame.depth_mm, frame.intrinsics, {.levels = true, .normals = outputs.normals},
                             maps3d_, times);
  const StageTimer timer(times, Stage::master_map);
  weigh_levels(frame.depth_mm);
  reduce(itti, symmetry2d);
  combine();
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
