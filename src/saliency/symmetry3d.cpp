#include "saliency/symmetry3d.hpp"

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "saliency/level_weight.hpp"
#include "saliency/pyramid.hpp"
#include "saliency/simd/simd_stages.hpp"

namespace saccade {

struct Symmetry3d::State {
  Symmetry3dParams params;
  const SimdStages& stages;
  Pyramid pyramid;

  State(const Symmetry3dParams& p, WorkerPool& pool, const std::string& simd)
      : params(p), stages(choose_simd_stages(simd)), pyramid(p, pool, stages) {}

  DepthRange load_depth(const cv::Mat1f& depth_mm);
  void build_levels(const Intrinsics& camera, DepthRange range);
  void find_normals(bool also_of_level_0);
  void find_symmetry();
  void copy_outputs(RequestedOutputs outputs, SaliencyMaps& maps) const;
  void add_levels(cv::Mat1f& master);
};

Symmetry3d::Symmetry3d(const Symmetry3dParams& params, WorkerPool& pool, const std::string& simd)
    : state_(std::make_unique<State>(params, pool, simd)) {}

Symmetry3d::~Symmetry3d() = default;

// Sections: those of README.md in this folder.
void Symmetry3d::compute(const cv::Mat1f& depth_mm, const Intrinsics& camera, RequestedOutputs outputs,
                         SaliencyMaps& maps, StageTimes& times) {
  compute_levels(depth_mm, camera, outputs, maps, times);
  const StageTimer timer(times, Stage::master_map);
  state_->add_levels(maps.master);  // Section 3, Eq. (15)
}

void Symmetry3d::compute_levels(const cv::Mat1f& depth_mm, const Intrinsics& camera, RequestedOutputs outputs,
                                SaliencyMaps& maps, StageTimes& times) {
  if (!camera.valid())
    throw std::invalid_argument("Symmetry3d: intrinsics must be finite, focal lengths above 0");
  State& state = *state_;
  state.pyramid.resize(depth_mm.size());
  {
    const StageTimer timer(times, Stage::points);
    const DepthRange range = state.load_depth(depth_mm);  // Section 1.1
    state.build_levels(camera, range);                    // Section 1.2
    state.find_normals(outputs.normals);                  // Section 1.3
  }
  {
    const StageTimer timer(times, Stage::symmetry);
    state.find_symmetry();  // Section 2, Eqs. (2) to (14)
  }
  const StageTimer timer(times, Stage::master_map);
  state.copy_outputs(outputs, maps);
}

// Section 1.1: the depth of level 0.
DepthRange Symmetry3d::State::load_depth(const cv::Mat1f& depth_mm) {
  DepthRange range;
  std::mutex mutex;
  pyramid.for_rows_of(0, [&](int begin, int end, RowScratch&) {
    const DepthRange rows = stages.load_rows(depth_mm, pyramid[0], begin, end);
    const std::scoped_lock lock(mutex);
    range.include(rows);
  });
  return range;
}

// Section 1.2: the depth of the other levels, and the camera of each.
void Symmetry3d::State::build_levels(const Intrinsics& camera, DepthRange range) {
  for (int l = 0; l <= params.last_level; ++l) {
    LevelPlanes& level = pyramid[l];
    level.camera = camera.at_level(l);
    level.packing = DepthPacking::for_depths(range.largest_mm, l > 0 || range.multiples_of_eighths,
                                             2 * params.reach() + 1);
    if (l == 0) continue;
    pyramid.for_rows_of(l, [&](int begin, int end, RowScratch& scratch) {
      stages.halve_rows(pyramid[l - 1], level, begin, end, scratch);
    });
  }
}

// Section 1.3: normals of the levels that the operator works on, and if asked for of level 0.
void Symmetry3d::State::find_normals(bool also_of_level_0) {
  pyramid.for_rows_of_all(
      [&](LevelPlanes& level, int begin, int end, RowScratch&) { stages.normal_rows(level, begin, end); });
  if (!also_of_level_0 || params.first_level == 0) return;
  pyramid.for_rows_of(0,
                      [&](int begin, int end, RowScratch&) { stages.normal_rows(pyramid[0], begin, end); });
}

// Section 2: the operator on each level.
void Symmetry3d::State::find_symmetry() {
  const WindowParams window{params.reach(), params.lambda_px()};
  pyramid.for_rows_of_all([&](LevelPlanes& level, int begin, int end, RowScratch& scratch) {
    stages.symmetry_rows(level, window, begin, end, scratch);
  });
}

// Section 3, from the coarsest level down: the sum of a level and all coarser ones replaces its map.
void Symmetry3d::State::add_levels(cv::Mat1f& master) {
  LevelPlanes& coarsest = pyramid[params.last_level];
  coarsest.scale_scores(level_weight(coarsest, params.normalisation));
  for (int l = params.last_level - 1; l >= 0; --l) {
    LevelPlanes& fine = pyramid[l];
    const float weight = l < params.first_level ? 0 : level_weight(fine, params.normalisation);
    pyramid.for_rows_of(l, [&](int begin, int end, RowScratch& scratch) {
      stages.add_upsampled_rows(fine, weight, pyramid[l + 1], begin, end, scratch);  // Eq. (15)
    });
  }
  pyramid[0].copy_scores(master);
}

void Symmetry3d::State::copy_outputs(RequestedOutputs outputs, SaliencyMaps& maps) const {
  maps.levels.resize(outputs.levels ? static_cast<std::size_t>(params.last_level - params.first_level + 1)
                                    : 0);
  for (std::size_t i = 0; i < maps.levels.size(); ++i)
    pyramid[params.first_level + static_cast<int>(i)].copy_scores(maps.levels[i]);
  if (outputs.normals)
    pyramid[0].copy_normals(maps.normals);
  else
    maps.normals.release();
}

}  // namespace saccade
