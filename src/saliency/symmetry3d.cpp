#include "saliency/symmetry3d.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "saliency/level_weight.hpp"
#include "saliency/simd/denormals.hpp"
#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"
#include "saliency/simd/simd_stages.hpp"

namespace saccade {
namespace {

// Rows that one worker takes at a time.
constexpr int kBandRows = 24;

// Below so many pixels it takes longer to wake the workers than to go over a level: 160 x 120 is still below.
constexpr int kWorthSharing = 32768;

struct Band {
  int level, begin, end;  // rows
};

std::vector<Band> bands_of(const std::vector<LevelPlanes>& levels, int first_level) {
  std::vector<Band> bands;
  for (int l = first_level; l < static_cast<int>(levels.size()); ++l)
    for (int r = 0; r < levels[static_cast<std::size_t>(l)].height(); r += kBandRows)
      bands.push_back({l, r, std::min(r + kBandRows, levels[static_cast<std::size_t>(l)].height())});
  return bands;
}

}  // namespace

struct Symmetry3d::State {
  Symmetry3dParams params;
  WorkerPool& pool;
  const SimdStages& stages;

  // For images of one size:
  cv::Size size;
  std::vector<LevelPlanes> levels;  // 0..last_level
  std::vector<RowScratch> scratch;  // of each worker
  std::vector<Band> bands;          // of levels first_level..last_level
  std::vector<DepthRange> ranges;   // of each band of level 0
  std::vector<float> weights;       // of each level in the master map

  State(const Symmetry3dParams& p, WorkerPool& workers, const std::string& simd)
      : params(p), pool(workers), stages(choose_simd_stages(simd)) {}

  void resize(cv::Size new_size);
  template <typename Job>
  void for_bands_of(int level, Job job);
  void load_pyramid(const cv::Mat1f& depth_mm, const Intrinsics& camera);
  void find_points(bool normals_wanted);
  void find_symmetry();
  void add_levels(cv::Mat1f& master);
  void copy_outputs(RequestedOutputs outputs, SaliencyMaps& maps) const;
};

void Symmetry3d::State::resize(cv::Size new_size) {
  if (new_size == size) return;
  check_levels(new_size, params);
  size = new_size;
  const int reach = params.kernel / 2;
  levels.clear();
  scratch.clear();
  for (int l = 0; l <= params.last_level; ++l) levels.emplace_back(level_size(size, l), reach);
  for (int w = 0; w < pool.workers(); ++w) {
    scratch.emplace_back(size.width);
    if (reach >= stages.runs_from_reach)
      scratch.back().row_sums = RowPrefixSums(size, reach, 2 * reach + RowScratch::kPreparedRows);
  }
  bands = bands_of(levels, params.first_level);
  ranges.resize(static_cast<std::size_t>((size.height + kBandRows - 1) / kBandRows));
  weights.assign(levels.size(), 0);
}

// Shares the rows of one level among the workers: job(begin, end, scratch, band).
template <typename Job>
void Symmetry3d::State::for_bands_of(int level, Job job) {
  const int height = levels[static_cast<std::size_t>(level)].height();
  const auto band = [&](int b, int worker) {
    job(b * kBandRows, std::min((b + 1) * kBandRows, height), scratch[static_cast<std::size_t>(worker)], b);
  };
  const int count = (height + kBandRows - 1) / kBandRows;
  if (height * levels[static_cast<std::size_t>(level)].width() < kWorthSharing) {
    for (int b = 0; b < count; ++b) band(b, 0);
    return;
  }
  pool.for_each(count, std::ref(band));
}

// SPEC 1.1 and 1.2
void Symmetry3d::State::load_pyramid(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
  for_bands_of(0, [&](int begin, int end, RowScratch&, int b) {
    ranges[static_cast<std::size_t>(b)] = stages.load_rows(depth_mm, levels[0], begin, end);
  });
  DepthRange all;
  for (const DepthRange& range : ranges) {
    all.largest_mm = std::max(all.largest_mm, range.largest_mm);
    all.multiples_of_eighths = all.multiples_of_eighths && range.multiples_of_eighths;
  }
  for (std::size_t l = 0; l < levels.size(); ++l) {
    levels[l].camera = camera.at_level(static_cast<int>(l));
    levels[l].packing = DepthPacking::for_depths(all.largest_mm, l > 0 || all.multiples_of_eighths,
                                                 params.kernel / 2 * 2 + 1);
    if (l > 0)
      for_bands_of(static_cast<int>(l), [&](int begin, int end, RowScratch& memory, int) {
        stages.halve_rows(levels[l - 1], levels[l], begin, end, memory);
      });
  }
}

// SPEC 1.3
void Symmetry3d::State::find_points(bool normals_wanted) {
  const auto job = [&](int b, int) {
    const Band& band = bands[static_cast<std::size_t>(b)];
    stages.normal_rows(levels[static_cast<std::size_t>(band.level)], band.begin, band.end);
  };
  pool.for_each(static_cast<int>(bands.size()), std::ref(job));
  if (normals_wanted && params.first_level > 0)
    for_bands_of(0, [&](int begin, int end, RowScratch&, int) { stages.normal_rows(levels[0], begin, end); });
}

// Section 2 of SPEC. Large levels come first, so that the small ones fill the gaps at the end.
void Symmetry3d::State::find_symmetry() {
  const WindowParams window{params.reach(), params.lambda_px()};
  const auto job = [&](int b, int worker) {
    const Band& band = bands[static_cast<std::size_t>(b)];
    stages.symmetry_rows(levels[static_cast<std::size_t>(band.level)], window, band.begin, band.end,
                         scratch[static_cast<std::size_t>(worker)]);
  };
  pool.for_each(static_cast<int>(bands.size()), std::ref(job));
}

// Eq. (15): each level's sum, from the coarsest down, takes the place of its map.
void Symmetry3d::State::add_levels(cv::Mat1f& master) {
  for (std::size_t l = 0; l < levels.size(); ++l)
    weights[l] = static_cast<int>(l) < params.first_level ? 0 : level_weight(levels[l], params.normalisation);
  levels.back().scale_scores(weights.back());
  for (int l = params.last_level - 1; l >= 0; --l) {
    const std::size_t fine = static_cast<std::size_t>(l);
    for_bands_of(l, [&](int begin, int end, RowScratch& memory, int) {
      stages.add_upsampled_rows(levels[fine], weights[fine], levels[fine + 1], begin, end, memory);
    });
  }
  master.create(size);
  for (int r = 0; r < size.height; ++r) {
    const float* row = levels[0].row(LevelPlanes::kScore, r);
    std::copy(row, row + size.width, master[r]);
  }
}

void Symmetry3d::State::copy_outputs(RequestedOutputs outputs, SaliencyMaps& maps) const {
  maps.levels.resize(outputs.levels ? levels.size() - static_cast<std::size_t>(params.first_level) : 0);
  for (std::size_t i = 0; i < maps.levels.size(); ++i) {
    const LevelPlanes& level = levels[i + static_cast<std::size_t>(params.first_level)];
    maps.levels[i].create(level.height(), level.width());
    for (int r = 0; r < level.height(); ++r)
      std::copy_n(level.row(LevelPlanes::kScore, r), level.width(), maps.levels[i][r]);
  }
  if (!outputs.normals) return maps.normals.release();
  maps.normals.create(size);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c)
      maps.normals(r, c) = {levels[0].row(LevelPlanes::kNormalX, r)[c],
                            levels[0].row(LevelPlanes::kNormalY, r)[c],
                            levels[0].row(LevelPlanes::kNormalZ, r)[c]};
}

Symmetry3d::Symmetry3d(const Symmetry3dParams& params, WorkerPool& pool, const std::string& simd)
    : state_(std::make_unique<State>(params, pool, simd)) {}

Symmetry3d::~Symmetry3d() = default;

void Symmetry3d::compute(const cv::Mat1f& depth_mm, const Intrinsics& camera, RequestedOutputs outputs,
                         SaliencyMaps& maps, StageTimes& times) {
  if (!camera.valid())
    throw std::invalid_argument("Symmetry3d: intrinsics must be finite, focal lengths above 0");
  State& state = *state_;
  state.resize(depth_mm.size());
  {
    const StageTimer timer(times, Stage::points);
    state.load_pyramid(depth_mm, camera);
    state.find_points(outputs.normals);
  }
  {
    const StageTimer timer(times, Stage::symmetry);
    state.find_symmetry();
  }
  const StageTimer timer(times, Stage::master_map);
  state.copy_outputs(outputs, maps);
  state.add_levels(maps.master);
}

}  // namespace saccade
