#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"
#include "tracking/held_objects.hpp"
#include "tracking/object_memory.hpp"
#include "tracking/own_colour.hpp"

namespace saccade {

/// Which objects are parts of one thing: the boards of a shelf, the legs of a table, a lamp and its pole.
/// Concave edges and jumps cut a thing into segments, and no edge says whether the thing ends there. Two
/// objects are parts of one thing if one of them holds the other (HeldObjects), or if they cling and have one
/// colour:
///  - they cling if the cells where the two touch without a jump in depth are at least kContact of the
///  outline
///    of one of them;
///  - the colour is the same if mean and spread of the chromaticity (b, g, r) / (b + g + r) differ by less
///    than kSameColour; or if kOwnShare of each have a colour of their own (OwnColour) and these differ by
///    less than kSameOwnColour, unless one was cut out by its colour. The logarithm of the brightness differs
///    by less than kSameBrightness.
/// Once an object has been seen in more than kNewFrames frames it is no longer found to be a part, so that
/// what was reported for a while is not given up. For the same reason, something new joins two things whose
/// reported objects are older than that only if its colour is surer: kBridge of the limits. Parts that are
/// not found again for kKeep_s are no longer parts. All that hangs together so is one thing, and the object
/// in sight that was chosen most often, first the oldest, is reported for it. Keeps its memory between
/// frames. Thread safety: one call at a time per object.
class ObjectParts {
 public:
  static constexpr double kContact = 0.015;
  static constexpr double kSameColour = 0.045;
  static constexpr double kOwnShare = 0.65, kSameOwnColour = 0.03;
  static constexpr double kSameBrightness = 1;
  static constexpr int kNewFrames = 6;
  static constexpr double kBridge = 0.5;
  static constexpr double kKeep_s = 3;

  /// Forgets what has been seen.
  void clear() { pairs_.clear(); }

  /// Sets TrackedObject::thing of all objects; after ObjectShapes::claim(). colour: H x W of the grid's
  /// frame, BGR; without it only what is held is found. seconds: since the last frame.
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
    std::optional<cv::Vec2f> own;   // its own colour, if it was not cut out by it
    double own_log_brightness = 0;  // of the cells that have it
  };

  void find_cells(const SurfaceGrid& grid, const SurfaceSegments& segments, const ObjectMemory& objects);
  void look_at(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat3b& colour,
               const TrackedObject& object, int slot);
  double log_brightness_of(const cv::Vec2f& own) const;
  void count_contacts(const SurfaceGrid& grid);
  bool cling(std::size_t a, std::size_t b, double tolerance) const;
  static bool have_one_colour(const Look& one, const Look& other, double tolerance);
  void pair_up(ObjectMemory& objects);
  bool bridge(const TrackedObject& a, const TrackedObject& b, ObjectMemory& objects);
  Pair* find_pair(const TrackedObject& a, const TrackedObject& b);
  void note(const TrackedObject& a, const TrackedObject& b, ObjectMemory& objects);
  void name_things(ObjectMemory& objects) const;

  std::vector<Pair> pairs_;
  HeldObjects held_;
  OwnColour own_colour_;
  std::vector<int> slot_of_;        // of each cell; -1 = no object's
  std::vector<Look> looks_;         // by slot
  std::vector<cv::Vec2f> colours_;  // of the cells of one object
  std::vector<double> brightness_;  // of the same
  std::vector<int> links_;  // between the cells of two slots, by slot * slots + slot, the smaller first
};

}  // namespace saccade
