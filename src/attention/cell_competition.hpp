#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// Mean of `saliency` over each cell of SurfaceGrid (pixels beyond the border count as 0), smoothed along
/// rows and columns by the binomial [1 8 28 56 70 56 28 8 1]/256 (a Gaussian of 1.4 cells; 0 beyond the
/// border). `scratch` and `smooth` (row by row) are reused.
void smooth_cells(const cv::Mat1f& saliency, std::vector<float>& scratch, std::vector<float>& smooth);

/// The cells of a SurfaceGrid compete by their values: the largest wins, and then it and its neighbourhood
/// are inhibited, so that another one wins next. Keeps its memory between frames. Thread safety: one call at
/// a time per object.
class CellCompetition {
 public:
  static constexpr int kMarginCells = 3;  ///< radius; 12 px
  static constexpr float kReturnDepth = 0.6F;
  static constexpr float kReturnReach = 3.0F / 32;  ///< 60 px of 640

  /// Begins a competition of rows x cols cells. `values`: row by row, finite, >= 0.
  void begin(const std::vector<float>& values, int rows, int cols);

  /// The cell with the largest value; ties: lowest row, then lowest column. None if no value is above 0.
  [[nodiscard]] std::optional<int> winner() const;

  float value(int cell) const { return value_[static_cast<std::size_t>(cell)]; }

  /// Sets the values of `cells` and of the margin of kMarginCells around them to 0.
  void inhibit(const std::vector<int>& cells);

  /// The same, but spares the cells of the margin for which spare(cell) is true.
  template <typename Spare>
  void inhibit(const std::vector<int>& cells, Spare spare);

  /// Inhibition of return: every value is multiplied by 1 - kReturnDepth * exp(-d^2 / 2 s^2), d the distance
  /// from the cell and s = kReturnReach of the width.
  void discount_around(int cell);

 private:
  // Of the disc of kMarginCells: how far its row reaches to both sides, by the row's distance from the
  // middle.
  static constexpr std::array<int, kMarginCells + 1> kMarginWidth = {3, 2, 2, 0};

  void make_return_table();
  bool is_inner(int cell) const;
  void update_row(int row);

  int rows_ = 0, cols_ = 0;
  std::vector<float> value_;
  std::vector<float> row_best_;           // largest value of each row
  std::vector<float> return_table_;       // exp(-d^2 / 2 s^2) by d in cells, d = 0 in its middle
  std::vector<unsigned char> inhibited_;  // by cell; those of the present inhibit()
};

template <typename Spare>
void CellCompetition::inhibit(const std::vector<int>& cells, Spare spare) {
  inhibited_.assign(value_.size(), 0);
  int first_row = rows_, last_row = -1;
  for (int i : cells) {
    inhibited_[static_cast<std::size_t>(i)] = 1;
    first_row = std::min(first_row, i / cols_ - kMarginCells);
    last_row = std::max(last_row, i / cols_ + kMarginCells);
  }
  for (int i : cells) {
    value_[static_cast<std::size_t>(i)] = 0;
    if (is_inner(i)) continue;  // only cells at the rim reach beyond it
    const int row = i / cols_, col = i % cols_;
    for (int v = std::max(-kMarginCells, -row); v <= std::min(kMarginCells, rows_ - 1 - row); ++v) {
      const int half = kMarginWidth[static_cast<std::size_t>(std::abs(v))];
      const int first = std::max(0, col - half), last = std::min(cols_ - 1, col + half);
      for (int j = (row + v) * cols_ + first; j <= (row + v) * cols_ + last; ++j)
        if (!spare(j)) value_[static_cast<std::size_t>(j)] = 0;
    }
  }
  for (int row = std::max(0, first_row); row <= std::min(rows_ - 1, last_row); ++row) update_row(row);
}

}  // namespace saccade
