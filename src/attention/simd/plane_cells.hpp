#pragma once

#include <cstddef>

namespace saccade {

/// Cells as arrays of `count` elements: place in the grid and inverse depth (1/mm, above 0).
struct PlaneCells {
  const float *col, *row, *w;
  std::size_t count;
};

/// How many cells lie in the plane w = a*col + b*row + c: within `reach`, a part of their depth. In float. If
/// that is no more than `least`, any number up to `least`, since the count ends when the rest is too few.
int count_in_plane(const PlaneCells& cells, float a, float b, float c, float reach, int least);

/// Sums over cells for a least-squares plane w = a*u + b*v + c; u = col, v = row.
struct PlaneSums {
  double n = 0, u = 0, v = 0, uu = 0, vv = 0, uv = 0, w = 0, uw = 0, vw = 0;
};

/// Sums over the cells in the plane. In double.
PlaneSums sum_in_plane(const PlaneCells& cells, double a, double b, double c, double reach);

}  // namespace saccade
