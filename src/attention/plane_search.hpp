#pragma once

#include <optional>
#include <span>
#include <vector>

#include "attention/surface_grid.hpp"

namespace saccade {

struct PlaneCells;

/// A plane in inverse depth: 1/z = a*col + b*row + c, 1/mm, col and row in cells of a SurfaceGrid.
struct InversePlane {
  double a = 0, b = 0, c = 0;

  double at(int row, int col) const { return a * col + b * row + c; }
};

/// Finds the plane that holds the most of a set of cells (README.md, section 4). Least squares over all of
/// them would fail where they span several planes; so the planes through single cells are tried.
/// Keeps its memory between calls. Thread safety: one find() at a time per object.
class PlaneSearch {
 public:
  static constexpr int kCandidates = 150;
  static constexpr float kCandidateReach = 0.02F;  ///< of the depth; cells nearer to a candidate vote for it
  static constexpr double kFirstReach = 0.024;     ///< of the depth; for the first round of least squares
  static constexpr double kReach = 0.012;          ///< of the depth; cells nearer to the plane are in it
  static constexpr int kRounds = 4;                ///< of least squares

  struct Found {
    InversePlane plane;
    double share = 0;  ///< part of the cells that is in the plane, within kReach
  };

  /// `cells`: indices into `grid`, ascending, all with depth. None if too few have a normal, or all lie on
  /// one line. Only the cells of even rows and columns are counted.
  std::optional<Found> find(const SurfaceGrid& grid, std::span<const int> cells);

 private:
  void sample(const SurfaceGrid& grid, std::span<const int> cells);
  std::optional<InversePlane> best_candidate(const SurfaceGrid& grid) const;
  bool refine(InversePlane& plane, double reach) const;
  double share_in(const InversePlane& plane) const;
  PlaneCells counted() const;

  std::vector<float> col_, row_, w_;  ///< of the cells that are counted
  std::vector<int> with_normal_;      ///< of all cells
};

}  // namespace saccade
