#include "saliency/pyramid.hpp"

namespace saccade {

void Pyramid::resize(cv::Size size) {
  if (size == size_) return;
  check_levels(size, params_);
  size_ = {};  // until all memory is there: after std::bad_alloc the next frame starts again
  const int reach = params_.reach();
  levels_.clear();
  bands_.clear();
  for (int l = 0; l <= params_.last_level; ++l) {
    levels_.emplace_back(level_size(size, l), reach);
    const int height = levels_.back().height();
    for (int r = 0; l >= params_.first_level && r < height; r += kBandRows)
      bands_.push_back({l, r, std::min(r + kBandRows, height)});
  }
  scratch_.clear();
  for (int w = 0; w < pool_.workers(); ++w) {
    scratch_.emplace_back(size.width);
    if (reach >= stages_.runs_from_reach)
      scratch_.back().row_sums = RowPrefixSums(size, reach, 2 * reach + RowScratch::kPreparedRows);
  }
  size_ = size;
}

}  // namespace saccade
