#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "core/worker_pool.hpp"
#include "saliency/params.hpp"
#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"
#include "saliency/simd/simd_stages.hpp"

namespace saccade {

/// The levels of the pyramid for images of one size, the scratch memory of each worker, and how workers share
/// the rows. The memory stays until the size changes.
class Pyramid {
 public:
  /// `pool` and `stages` must outlive this.
  Pyramid(const Symmetry3dParams& params, WorkerPool& pool, const SimdStages& stages)
      : params_(params), pool_(pool), stages_(stages) {}

  /// Allocates for images of `size`, unless that is the size already. Throws as check_levels().
  void resize(cv::Size size);

  cv::Size size() const { return size_; }
  int first_level() const { return params_.first_level; }
  int last_level() const { return params_.last_level; }
  LevelPlanes& operator[](int level) { return levels_[static_cast<std::size_t>(level)]; }
  const LevelPlanes& operator[](int level) const { return levels_[static_cast<std::size_t>(level)]; }

  /// Divides the rows of one level among the workers: job(begin, end, scratch).
  template <typename Job>
  void for_rows_of(int level, Job job);

  /// Divides the rows of levels first_level..last_level among the workers: job(level, begin, end, scratch).
  /// Large levels come first, so that the small ones fill the gaps at the end.
  template <typename Job>
  void for_rows_of_all(Job job);

 private:
  /// Rows that one worker takes at a time.
  static constexpr int kBandRows = 24;
  /// The calling thread does levels with fewer pixels (160 x 120) alone: waking the others takes longer.
  static constexpr int kWorthSharing = 32768;

  struct Band {
    int level, begin, end;  ///< rows
  };

  Symmetry3dParams params_;
  WorkerPool& pool_;
  const SimdStages& stages_;
  cv::Size size_;
  std::vector<LevelPlanes> levels_;  ///< 0..last_level
  std::vector<RowScratch> scratch_;  ///< of each worker
  std::vector<Band> bands_;          ///< of levels first_level..last_level
};

template <typename Job>
void Pyramid::for_rows_of(int level, Job job) {
  const LevelPlanes& planes = (*this)[level];
  const int height = planes.height(), bands = (height + kBandRows - 1) / kBandRows;
  const auto band = [&](int b, int worker) {
    job(b * kBandRows, std::min((b + 1) * kBandRows, height), scratch_[static_cast<std::size_t>(worker)]);
  };
  if (height * planes.width() >= kWorthSharing) return pool_.for_each(bands, std::ref(band));
  for (int b = 0; b < bands; ++b) band(b, 0);
}

template <typename Job>
void Pyramid::for_rows_of_all(Job job) {
  const auto chunk = [&](int b, int worker) {
    const Band& band = bands_[static_cast<std::size_t>(b)];
    job((*this)[band.level], band.begin, band.end, scratch_[static_cast<std::size_t>(worker)]);
  };
  pool_.for_each(static_cast<int>(bands_.size()), std::ref(chunk));
}

}  // namespace saccade
