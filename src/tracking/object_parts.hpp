#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"
#include "tracking/object_memory.hpp"

namespace saccade {

/// Which objects are parts of one thing: the boards of a shelf, the legs of a table. Concave edges cut a
/// thing into segments, and no edge says whether the thing ends there; so colour decides. An object that is
/// found clinging to another one, of the same colour, is a part of the same thing:
///  - it clings if the cells where the two touch without a jump in depth are at least kContact of the outline
///    of one of them;
///  - the colour is the same if mean and spread of the chromaticity (b, g, r) / (b + g + r) differ by less
///    than kSameColour, and the logarithm of the brightness by less than kSameBrightness.
/// Once an object has been seen in more than kNewFrames frames it is no longer found to be a part, so that
/// what was reported for a while is not given up. Parts that do not cling for kKeep_s are no longer parts.
/// All that hangs together so is one thing, and the oldest object in sight is reported for it. Without colour
/// every object is a thing. Keeps its memory between frames. Thread safety: one call at a time per object.
class ObjectParts {
 public:
  static constexpr double kContact = 0.015;
  static constexpr double kSameColour = 0.045;
  static constexpr double kSameBrightness = 1;
  static constexpr int kNewFrames = 6;
  static constexpr double kKeep_s = 3;

  /// Forgets what has been seen.
  void clear() { pairs_.clear(); }

  /// Sets TrackedObject::thing of all objects; after ObjectShapes::claim(). colour: H x W of the grid's
  /// frame, BGR; empty = none. seconds: since the last frame.
  void find(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat3b& colour, double seconds,
            ObjectMemory& objects);

 private:
  // Two objects, by id, that are parts of one thing.
  struct Pair {
    int a, b;
    double left_s = kKeep_s;  // until they are none, if they do not cling
  };

  // How an object looks in a frame, in its segments that are no supporting planes.
  struct Look {
    int outline = 0;   // pairs of neighbouring cells of which one is its own
    cv::Vec3d colour;  // mean chromaticity
    double spread = 0, log_brightness = 0;
  };

  void look_at(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat3b& colour,
               const ObjectMemory& objects);
  void look_at(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat3b& colour,
               const TrackedObject& object, int slot);
  void count_contacts(const SurfaceGrid& grid);
  bool cling(std::size_t a, std::size_t b) const;
  void pair_up(const ObjectMemory& objects);
  void note(const TrackedObject& a, const TrackedObject& b);
  void name_things(ObjectMemory& objects) const;

  std::vector<Pair> pairs_;
  std::vector<Look> looks_;   // by slot
  std::vector<int> slot_of_;  // of each cell; -1 = no object's
  std::vector<int> links_;    // between the cells of two slots, by slot * slots + slot, the smaller first
};

}  // namespace saccade
