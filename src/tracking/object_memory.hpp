#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/affine.hpp>

#include "attention/surface_grid.hpp"
#include "tracking/tracked_object.hpp"

namespace saccade {

/// The objects that are remembered, and where each is in the present frame. An object keeps its slot while it
/// is remembered; SurfaceMemory::owner() names it by owner_of(slot). Ids are never used twice,
/// unless number_from() says so.
/// Thread safety: one call at a time per object.
class ObjectMemory {
 public:
  static constexpr int kSurfacePoints = 64;  ///< at most, of an object
  static constexpr int kEmptyFrames = 2;     ///< in a row, until an object whose place is empty is forgotten
  static constexpr int kMissedFrames = 2;    ///< in a row, until a candidate that is not chosen is forgotten

  /// memory_s: how long an object that is not reported is remembered.
  explicit ObjectMemory(double memory_s) : memory_s_(memory_s) {}

  void set_memory(double memory_s) { memory_s_ = memory_s; }

  /// Forgets all objects; their ids are not used again.
  void clear();

  /// The slots; those of forgotten objects are not alive.
  std::vector<TrackedObject>& slots() { return slots_; }
  const std::vector<TrackedObject>& slots() const { return slots_; }

  /// The object with an id; nullptr if it is not remembered.
  TrackedObject* find(int id);

  /// A new candidate, in a slot that may have been another's. May move the slots.
  TrackedObject& add();
  void give_id(TrackedObject& object) { object.id = next_id_++; }
  int next_id() const { return next_id_; }

  /// Later ids count from `first`, >= 1; no object that is remembered may have such an id.
  void number_from(int first) { next_id_ = first; }

  static int owner_of(std::size_t slot) { return static_cast<int>(slot) + 1; }
  int owner_of(const TrackedObject& object) const {
    return owner_of(static_cast<std::size_t>(&object - slots_.data()));
  }
  /// nullptr for SurfaceMemory::kNobody.
  TrackedObject* of_owner(int owner) {
    return owner == 0 ? nullptr : &slots_[static_cast<std::size_t>(owner - 1)];
  }

  /// Moves what the frame before saw: the world was corrected.
  void correct(const cv::Affine3d& correction);

  /// Looks where the objects are in a frame: sight, anchor and seen cells of each. `from_world`: world to
  /// camera.
  void predict(const SurfaceGrid& grid, const cv::Affine3d& from_world);

  /// Takes the surface of the objects that are visible, from their cells.
  void learn(const SurfaceGrid& grid, const cv::Affine3d& to_world);

  /// Forgets the objects whose place is empty, candidates that are no longer chosen, and objects that were
  /// not reported for memory_s. Their cells in `owner` become nobody's.
  void forget(std::int64_t time_us, std::vector<int>& owner);

 private:
  void look_at_surface(const SurfaceGrid& grid, const cv::Affine3d& from_world, TrackedObject& object) const;
  bool goes_home(const SurfaceGrid& grid, const cv::Affine3d& from_world, TrackedObject& object) const;
  void look_at_anchor(const SurfaceGrid& grid, const cv::Affine3d& from_world, TrackedObject& object) const;
  static bool candidate_stays(TrackedObject& candidate);
  bool is_remembered(const TrackedObject& object, std::int64_t time_us) const;

  double memory_s_;
  int next_id_ = 1;
  std::vector<TrackedObject> slots_;
};

}  // namespace saccade
