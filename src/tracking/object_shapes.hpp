#pragma once

#include <vector>

#include <opencv2/core/affine.hpp>

#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"
#include "tracking/object_memory.hpp"
#include "tracking/surface_memory.hpp"

namespace saccade {

/// Which cells of a frame are whose. The cells that an object had are carried along by SurfaceMemory; the
/// segmentation of the frame has the word about its outline, but not about what exists: the noise joins and
/// cuts segments from frame to frame.
///  - The segment under an object's anchor becomes the object's shape if it covers about the cells that were
///    carried, or if it has been another one for kPatience_s.
///  - A segment that was cut out by its colour (ColourPatches) is at once the shape of the object that has
///  its
///    anchor there, and no other object's.
///  - A segment in which several objects have a good part of their cells is divided: each keeps its cells,
///  the
///    rest goes to the object with the nearest anchor.
///  - An object without a segment has a disc around its anchor, as ProtoObjects.
///  - An object whose place is empty is followed to a segment of about its size that has just appeared there,
///    not farther away than it is large: it was moved.
/// Keeps its memory between frames. Thread safety: one call at a time per object.
class ObjectShapes {
 public:
  static constexpr double kSameShape = 0.5;  ///< intersection over union, at least
  static constexpr double kGoodPart = 0.25;  ///< of an object's cells
  static constexpr double kPatience_s = 1.0 / 3;
  static constexpr int kAnchorCells = 2;  ///< radius of what is always an object's own, around its anchor

  /// After SurfaceMemory::carry() and ObjectMemory::predict(). Sets segment and cells of each object, and the
  /// owner of each cell. `to_world`: camera to world, mm. seconds: since the last frame.
  void claim(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Affine3d& to_world,
             double seconds, ObjectMemory& objects, SurfaceMemory& surfaces);

  /// The segments of a frame, by number.
  struct Segment {
    int cells = 0, owned = 0, appeared = 0;  ///< all; that are an object's; where nothing was before
    cv::Point3d centroid_mm;                 ///< camera frame
    double area_mm2 = 0;
    int claims = 0;                         ///< objects with an id that have a good part of their cells in it
    int claimant = -1, claimant_cells = 0;  ///< slot of the one with the most cells in it, -1 = none
    int part_of = -1;                       ///< slot of the object that most of its cells were carried from
    bool taken = false;                     ///< it is the shape of one object
  };
  const Segment& segment(int number) const { return facts_[static_cast<std::size_t>(number)]; }

 private:
  void measure_segments(const SurfaceMemory& surfaces);
  void collect_cells(ObjectMemory& objects, SurfaceMemory& surfaces);
  void seed(ObjectMemory& objects, SurfaceMemory& surfaces);
  void follow_moved(ObjectMemory& objects, const cv::Affine3d& to_world, SurfaceMemory& surfaces);
  int segment_moved_to(const TrackedObject& object, const cv::Affine3d& to_world) const;
  void choose_segments(ObjectMemory& objects, double seconds, SurfaceMemory& surfaces);
  void release_patches(TrackedObject& object, int own_segment, SurfaceMemory& surfaces) const;
  int choose_segment(TrackedObject& object, double seconds);
  void add_claims(const TrackedObject& object, int slot, int own_segment);
  void take_segments(ObjectMemory& objects, SurfaceMemory& surfaces);
  void divide_segments(ObjectMemory& objects, SurfaceMemory& surfaces);
  void keep_anchors(ObjectMemory& objects, SurfaceMemory& surfaces);
  void keep_anchor(TrackedObject& object, int owner, SurfaceMemory& surfaces) const;
  int segment_of(int cell) const { return (*of_cell_)[static_cast<std::size_t>(cell)]; }
  void count_overlaps(const std::vector<int>& cells);

  const SurfaceGrid* grid_ = nullptr;          // of the present call
  const SurfaceSegments* segments_ = nullptr;  // of the present call
  const std::vector<int>* of_cell_ = nullptr;  // of the present call
  std::vector<Segment> facts_;
  std::vector<int> overlap_;   // with each segment, of one object
  std::vector<int> shape_of_;  // owner of each segment that is one object's shape
};

}  // namespace saccade
