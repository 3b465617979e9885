#include "attention/cell_competition.hpp"

#include <array>
#include <cmath>
#include <span>

#include "attention/simd/cell_means.hpp"
#include "attention/simd/cell_pixels.hpp"
#include "attention/surface_grid.hpp"

namespace saccade {
namespace {

// Of a cell that the border cuts, the pixels outside count as 0.
float mean_of_cut_cell(const cv::Mat1f& saliency, int row, int col) {
  const CellPixels pixels(saliency, row, col);
  float sum = 0;
  for (int v = 0; v < kCellPx; ++v) {
    const float* const s = pixels.row(v);
    sum += ((s[0] + s[1]) + (s[2] + s[3])) / (kCellPx * kCellPx);
  }
  return sum;
}

void mean_of_cells(const cv::Mat1f& saliency, int rows, int cols, float* means) {
  for (int r = 0; r < rows; ++r) {
    float* const out = means + r * cols;
    const int top = r * kCellPx, whole = top + kCellPx <= saliency.rows ? saliency.cols / kCellPx : 0;
    if (whole > 0)
      mean_values({saliency[top], saliency[top + 1], saliency[top + 2], saliency[top + 3]}, out, at(whole));
    for (int c = whole; c < cols; ++c) out[c] = mean_of_cut_cell(saliency, r, c);
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
  constexpr int kReach = 4;
  constexpr std::array<float, 2 * kReach + 1> kWeights = {1.0F / 256,  8.0F / 256,  28.0F / 256,
                                                          56.0F / 256, 70.0F / 256, 56.0F / 256,
                                                          28.0F / 256, 8.0F / 256,  1.0F / 256};
  const std::span<const float> weights(kWeights);
  const int rows = (saliency.rows + kCellPx - 1) / kCellPx, cols = (saliency.cols + kCellPx - 1) / kCellPx;
  // The means, and behind them a row with zeros at both ends.
  scratch.resize(at(rows * cols + cols + 2 * kReach));
  mean_of_cells(saliency, rows, cols, scratch.data());
  float* const row = &scratch[at(rows * cols)];
  std::fill_n(row, cols + 2 * kReach, 0.0F);
  smooth.resize(at(rows * cols));
  std::array<const float*, 2 * kReach + 1> taken;
  for (int r = 0; r < rows; ++r) {
    const int first = std::max(0, r - kReach), last = std::min(rows - 1, r + kReach);
    const std::size_t count = at(last - first + 1);
    for (std::size_t k = 0; k < count; ++k) taken[k] = &scratch[at((first + static_cast<int>(k)) * cols)];
    add_weighted({taken.data(), count}, weights.subspan(at(first - r + kReach), count), row + kReach,
                 at(cols));
    for (std::size_t k = 0; k < taken.size(); ++k) taken[k] = row + k;
    add_weighted(taken, weights, &smooth[at(r * cols)], at(cols));
  }
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
