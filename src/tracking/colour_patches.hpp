#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/cells_of_segments.hpp"
#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"
#include "tracking/own_colour.hpp"

namespace saccade {

/// Cuts out of large segments what stands out of them by its colour: books between the boards of a shelf, a
/// cushion on a sofa. The noise of depth hides the edges between such things and what holds them, and the
/// point of the whole segment would be the only one for all of them. A large thing mostly has one colour: the
/// most frequent one of the segment is its own, if kOwnShare of its cells have it. What hangs together in
/// other colours becomes a segment, unless it is a narrow strip: those come from a colour image that is not
/// exactly registered. Keeps its memory between frames. Thread safety: one call at a time per object.
class ColourPatches {
 public:
  static constexpr double kLeastArea_mm2 = 250e3;  ///< of a segment that is searched
  static constexpr float kOtherColour = 0.08F;     ///< distance from its own colour of what may be cut out
  static constexpr double kOwnShare = 0.3;         ///< of the segment's cells
  static constexpr int kReach = 2;                 ///< cells; some cell of a patch has only its cells so near

  /// colour: H x W of the grid's frame, BGR; empty = nothing is cut.
  void cut(const SurfaceGrid& grid, const cv::Mat3b& colour, SurfaceSegments& segments);

 private:
  // Of each cell: `other` are those of another colour that have not been looked at, `patch` those of patch_.
  enum class State : unsigned char { none, other, patch, done };

  void measure_areas(const SurfaceGrid& grid, const SurfaceSegments& segments);
  bool mark_others(const SurfaceGrid& grid, const cv::Mat3b& colour, std::span<const int> cells);
  void collect(const SurfaceGrid& grid, int seed);
  bool is_strip(const SurfaceGrid& grid) const;

  CellsOfSegments cells_of_segments_;
  OwnColour own_colour_;
  std::vector<double> area_mm2_;   // by segment
  std::vector<cv::Vec2f> colour_;  // of each cell of one segment: blue and red
  std::vector<State> state_;
  std::vector<int> patch_;
};

}  // namespace saccade
