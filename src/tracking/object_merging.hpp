#pragma once

#include <vector>

#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"
#include "tracking/object_memory.hpp"
#include "tracking/surface_memory.hpp"

namespace saccade {

/// Whether the surface between two cells with depth is convex or flat, as far as the noise lets see: along
/// the line between them in the image, nothing lies farther than the straight line between them in space. So
/// two points of a convex thing have no gap between them, while a step down, a concave edge and the ground
/// between two things all make one.
[[nodiscard]] bool convex_between(const SurfaceGrid& grid, int from, int to);

/// Makes one object of two that are parts of one: noise may have cut its segment when they were found. Two
/// objects are one if for kPatience_s their anchors have been in one segment, and it is convex between them.
/// Keeps its memory between frames. Thread safety: one call at a time per object.
class ObjectMerging {
 public:
  static constexpr double kPatience_s = 1;

  /// Forgets what has been seen.
  void clear() { pairs_.clear(); }

  /// After ObjectShapes::claim(). The object that is later in order ends, and its cells become the other's.
  /// seconds: since the last frame.
  void merge(const SurfaceGrid& grid, const SurfaceSegments& segments, double seconds, ObjectMemory& objects,
             SurfaceMemory& surfaces);

 private:
  // Two objects, by id, that have seemed one.
  struct Pair {
    int a, b;
    bool now = false;  // in the present frame
    double seconds = 0;
  };

  void find_pairs(const SurfaceGrid& grid, const SurfaceSegments& segments, const ObjectMemory& objects);
  void note(int a, int b);
  static void join(TrackedObject& first, TrackedObject& second, ObjectMemory& objects,
                   SurfaceMemory& surfaces);

  std::vector<Pair> pairs_;
};

}  // namespace saccade
