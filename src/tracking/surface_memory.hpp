#pragma once

#include <vector>

#include <opencv2/core/affine.hpp>

#include "attention/surface_grid.hpp"

namespace saccade {

/// What is remembered of each cell of the surfaces in view, carried along as the camera moves: the mean of
/// its value over time, and whose it is. A cell is the same surface as a cell of the frame before if it lies
/// at that one's depth when it is seen from there; where none does, the memory of the cell begins again.
/// Arrays are row by row, of the grid of the last carry(). Keeps its memory between frames.
/// Thread safety: one call at a time per object.
class SurfaceMemory {
 public:
  static constexpr int kNobody = 0;

  /// The time over which old values lose their weight.
  static constexpr double kMean_s = 0.5;

  /// What a cell was, in the frame before.
  enum class Before : unsigned char {
    unknown,   ///< out of view or without a reading
    same,      ///< this surface
    behind,    ///< a surface behind this one: this one has come
    in_front,  ///< a surface before this one: this one was hidden
  };

  /// The least share that a value which comes `seconds` after the one before it has in a mean over the time
  /// `mean_s`.
  static double share_of(double seconds, double mean_s = kMean_s);

  /// Forgets all cells.
  void clear();

  /// Forgets the means alone: they begin again with the next values.
  void forget_means();

  /// Brings the memory to the cells of `grid`. `to_previous`: motion from this camera to that of the frame of
  /// the last call, mm; is not read after clear().
  void carry(const SurfaceGrid& grid, const cv::Affine3d& to_previous);

  /// Takes this frame's values into the means: of a cell seen for the n-th time by a share of 1/n, or, once
  /// that is less, share_of(seconds). So the first mean is the value itself. Once for each carry().
  /// seconds: since the last frame, >= 0.
  void learn(const std::vector<float>& values, double seconds);

  const std::vector<float>& mean() const { return now_.mean; }
  /// In how many frames the surface of each cell has been seen before this one.
  const std::vector<int>& age() const { return now_.age; }
  const std::vector<Before>& before() const { return before_; }

  /// Whose each cell is: an id, or kNobody. What is written here is carried to the next frame.
  std::vector<int>& owner() { return now_.owner; }
  const std::vector<int>& owner() const { return now_.owner; }

 private:
  struct Cells {
    std::vector<float> depth_mm, mean;
    std::vector<int> age, owner;
  };

  // Where a point of this frame is in the grid of the last one, cells, and its depth there.
  struct Place {
    double row, col, depth_mm;
  };

  void carry_cell(std::size_t i, const Place& place, int rows, int cols);

  Cells now_, last_;
  std::vector<Before> before_;
  bool empty_ = true;
};

}  // namespace saccade
