#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/affine.hpp>

#include "attention/cell_competition.hpp"
#include "attention/proto_objects.hpp"
#include "core/frame.hpp"
#include "tracking/object_memory.hpp"
#include "tracking/object_shapes.hpp"
#include "tracking/surface_memory.hpp"

namespace saccade {

/// The order of attention in a frame, with memory. As in ProtoSelector, cells compete, and the winner and its
/// neighbourhood are inhibited. But at each rank the object that is next in the order of the frame before
/// keeps its place, unless another cell is better by the factor kMargin; that cell then stands for its own
/// object, or for a candidate. A candidate becomes an object, with an id, when it was chosen in kConfirm
/// frames.
///
/// The objects of the last frame's order are *members* of it until they are seen and not chosen, or were away
/// for more than kAway_s. While there are as many members as places, a newcomer must be kEnter times as
/// strong as the weakest of them, each by the largest value of all its cells, unless it has appeared; it
/// takes that one's place. So what was reported does not fall out because something that is hardly stronger
/// came into view. A part of a thing is no member: another object is reported for it.
///
/// An object is as strong as the cells around its anchor. The anchor moves only if another place of the
/// object is better by kBetterPlace for kPatience_s, or if its own is hidden for so long, or out of view; one
/// that went out of view and is seen again within kAway_s goes back. It also moves once it has been at the
/// object's border for kPatience_s longer than inside, since noise moves the border from frame to frame.
/// Without memory (the first frame, or after a cut) the order, the cells and the points are those of
/// ProtoSelector. Keeps its memory between frames. Thread safety: one call at a time per object.
class AttentionOrder {
 public:
  static constexpr float kMargin = 3, kBetterPlace = 16;
  static constexpr float kEnter = 12;    ///< of a newcomer to an order that is full
  static constexpr int kPlaneCells = 3;  ///< of supporting planes, inhibited with an object beside its margin
  static constexpr int kConfirm = 3;
  static constexpr double kPatience_s = 0.5;
  static constexpr double kAway_s = 0.5;  ///< what comes back later is no member, and its anchor has moved
  static constexpr int kPlaceCells = 3;   ///< radius, of the cells around an anchor
  static constexpr int kStandInCells =
      6;  ///< radius in which another cell stands in for an anchor that is hidden

  /// What has just come into a place that was seen without it counts kAppeared times its value for
  /// kAppeared_s.
  static constexpr float kAppeared = 4;
  static constexpr double kAppeared_s = 2;
  static constexpr int kAppearedCells = 12;     ///< fewer are the rim of something
  static constexpr double kAppearedPart = 0.5;  ///< of a segment's cells

  /// The frame of one call, whose parts must fit each other.
  struct View {
    const Frame& frame;
    const cv::Mat1f& saliency;
    const SurfaceGrid& grid;
    const SurfaceSegments& segments;
    const cv::Affine3d &to_world, &from_world;  ///< camera to world and back, mm
    double seconds;                             ///< since the last frame
    bool first;                                 ///< there is no memory
  };

  /// Chooses at most `count` objects; after ObjectShapes::claim(). Gives their slots, first in order first.
  const std::vector<std::size_t>& choose(const View& view, int count, const ObjectShapes& shapes,
                                         ProtoObjects& proto_objects, ObjectMemory& objects,
                                         SurfaceMemory& surfaces);

 private:
  // A cell and its value.
  struct Peak {
    int cell = -1;
    float value = 0;
  };

  void begin(const ObjectShapes& shapes);
  bool has_appeared(int segment, const ObjectShapes& shapes) const;
  void list_expected();
  bool was_away(const TrackedObject& object) const;
  TrackedObject* expected();
  void rank_the_rest();
  TrackedObject* last_to_stay(int count);
  bool may_enter(int cell, int count, const ObjectShapes& shapes);
  void make_room(const TrackedObject& newcomer, int count);
  TrackedObject& stands_for(int cell, const ObjectShapes& shapes, ProtoObjects& proto_objects);
  int slot_of(int segment, int cell, const ObjectShapes& shapes) const;
  TrackedObject& new_candidate(int cell, const ObjectShapes& shapes, ProtoObjects& proto_objects);
  bool confirm(TrackedObject& object);
  void take(TrackedObject& object, const ProtoObjects& proto_objects);
  void inhibit(const TrackedObject& object);
  void reach_over_planes(const TrackedObject& object);
  bool is_free_plane(int cell, const TrackedObject& object) const;
  Peak best_of(const TrackedObject& object) const;
  Peak best_at_anchor(const TrackedObject& object) const;
  float strength(const TrackedObject& object) const;
  int settle_anchor(TrackedObject& object, const ProtoObjects& proto_objects) const;
  int cell_inside(const TrackedObject& object) const;
  int stand_in(const TrackedObject& object) const;
  void move_anchor(TrackedObject& object, int cell, const ProtoObjects& proto_objects) const;

  const View* view_ = nullptr;         // of the present call
  ObjectMemory* objects_ = nullptr;    // of the present call
  SurfaceMemory* surfaces_ = nullptr;  // of the present call
  CellCompetition competition_;
  std::vector<float> values_;
  std::vector<std::size_t> expected_;  // slots in the order of the frame before
  std::size_t next_expected_ = 0;
  std::vector<std::size_t> chosen_;
  std::vector<int> reached_;             // cells that an object inhibits
  std::vector<unsigned char> in_reach_;  // by cell: whether it is one of these
};

}  // namespace saccade
