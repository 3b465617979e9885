#include "attention/cell_competition.hpp"

#include <array>
#include <cmath>

#include "attention/surface_grid.hpp"

namespace saccade {
namespace {

constexpr int kCell = SurfaceGrid::kCellPx;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void mean_of_cells(const cv::Mat1f& saliency, int rows, int cols, std::vector<float>& means) {
  means.assign(at(rows) * at(cols), 0.0F);
  constexpr float kShare = 1.0F / (kCell * kCell);
  for (int r = 0; r < saliency.rows; ++r) {
    const float* line = saliency[r];
    float* out = &means[at(r / kCell) * at(cols)];
    const int whole = saliency.cols / kCell;
    for (int c = 0; c < whole; ++c) {
      const float* s = line + c * kCell;
      out[c] += ((s[0] + s[1]) + (s[2] + s[3])) * kShare;
    }
    for (int c = whole * kCell; c < saliency.cols; ++c) out[whole] += line[c] * kShare;
  }
}

// The largest of `count` values >= 0; 0 if there are none. In lanes, so that compilers make vectors of it.
float largest_of(const float* values, int count) {
  constexpr int kLanes = 8;
  std::array<float, kLanes> best{};
  int i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k)
      best[k] = values[at(i) + k] > best[k] ? values[at(i) + k] : best[k];
  for (; i < count; ++i) best[0] = std::max(best[0], values[i]);
  return *std::max_element(best.begin(), best.end());
}

}  // namespace

void smooth_cells(const cv::Mat1f& saliency, std::vector<float>& scratch, std::vector<float>& smooth) {
  constexpr std::array<float, 5> kWeights = {70.0F / 256, 56.0F / 256, 28.0F / 256, 8.0F / 256, 1.0F / 256};
  const int rows = (saliency.rows + kCell - 1) / kCell, cols = (saliency.cols + kCell - 1) / kCell;
  mean_of_cells(saliency, rows, cols, scratch);
  smooth.assign(scratch.size(), 0.0F);
  const auto add = [](const float* from, float* to, int count, float weight) {
    for (int i = 0; i < count; ++i) to[i] += from[i] * weight;
  };
  for (int r = 0; r < rows; ++r)
    for (int d = -4; d <= 4; ++d)
      if (r + d >= 0 && r + d < rows)
        add(&scratch[at((r + d) * cols)], &smooth[at(r * cols)], cols, kWeights[at(std::abs(d))]);
  scratch.swap(smooth);
  std::fill(smooth.begin(), smooth.end(), 0.0F);
  for (int r = 0; r < rows; ++r)
    for (int d = -4; d <= 4; ++d)
      if (const int count = cols - std::abs(d); count > 0)
        add(&scratch[at(r * cols + std::max(0, d))], &smooth[at(r * cols + std::max(0, -d))], count,
            kWeights[at(std::abs(d))]);
}

void CellCompetition::begin(const std::vector<float>& values, int rows, int cols) {
  rows_ = rows;
  cols_ = cols;
  value_ = values;
  row_best_.resize(at(rows));
  for (int row = 0; row < rows; ++row) update_row(row);
  make_return_table();
}

std::optional<int> CellCompetition::winner() const {
  const auto best = std::max_element(row_best_.begin(), row_best_.end());
  if (best == row_best_.end() || !(*best > 0)) return std::nullopt;
  const auto begin = value_.begin() + (best - row_best_.begin()) * cols_;
  return static_cast<int>(std::find(begin, begin + cols_, *best) - value_.begin());
}

void CellCompetition::inhibit(const std::vector<int>& cells) {
  inhibit(cells, [](int) { return false; });
}

// Whether all four neighbours are inhibited too.
bool CellCompetition::is_inner(int cell) const {
  const int row = cell / cols_, col = cell % cols_;
  return row > 0 && col > 0 && row + 1 < rows_ && col + 1 < cols_ && inhibited_[at(cell - 1)] &&
         inhibited_[at(cell + 1)] && inhibited_[at(cell - cols_)] && inhibited_[at(cell + cols_)];
}

void CellCompetition::update_row(int row) {
  row_best_[at(row)] = largest_of(value_.data() + row * cols_, cols_);
}

void CellCompetition::make_return_table() {
  const float sigma = kReturnReach * static_cast<float>(cols_);
  const int reach = std::max(rows_, cols_);
  return_table_.resize(at(2 * reach + 1));
  for (int d = 0; d <= reach; ++d) {
    const float x = static_cast<float>(d) / sigma;
    return_table_[at(reach + d)] = return_table_[at(reach - d)] = std::exp(-0.5F * x * x);
  }
}

void CellCompetition::discount_around(int cell) {
  const int row = cell / cols_, col = cell % cols_;
  const int middle = std::max(rows_, cols_);
  const float* const along_row = &return_table_[at(middle - col)];
  for (int r = 0; r < rows_; ++r) {
    const float depth = kReturnDepth * return_table_[at(middle + r - row)];
    float* value = &value_[at(r * cols_)];
    for (int c = 0; c < cols_; ++c) value[c] *= 1 - depth * along_row[c];
    update_row(r);
  }
}

}  // namespace saccade
