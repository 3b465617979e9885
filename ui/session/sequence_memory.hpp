#pragma once

#include <cstdint>
#include <map>

#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"
#include "ui/session/object_numbers.hpp"
#include "ui/session/sequence_marks.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// Attention over time of one side of the viewer, where a frame may be computed several times with settings
/// that change: every computation of a frame begins with the memory as it was when the frame came, so that
/// tuning a paused frame does not advance it. Thread safety: one call at a time per object.
class SequenceMemory {
 public:
  SequenceMemory() : before_{AttentionTracker(1, 0, {})}, now_(before_) {}

  /// A new frame comes: later computations begin with what the last one has left.
  void next_frame();

  /// Chooses the attention points of a frame that has its map, and sets their marks. `follower`: has followed
  /// it. number: counts the frames that were followed, from 1; a memory that has missed one goes on from
  /// that of the other side or, if that has missed it too, begins again. After a cut both sides number their
  /// objects from the same id: 1 if the source went back (a loop), which begins the sequence again, else the
  /// next that neither has used.
  void attend(const FrameFollower& follower, std::int64_t number, const SequenceMemory& other,
              Computed& computed);

  /// Replaces the ids of the objects of a frame by the numbers that both sides have in common
  /// (assign_numbers()). To be called after each computation of the frame, for the sides that follow the
  /// sequence; null = this one does not. Their points are those of attend(), or copies of points that have
  /// been here for the same frame.
  static void number_objects(SequenceMemory& a, Computed* of_a, SequenceMemory& b, Computed* of_b);

 private:
  struct Numbers {
    std::map<int, int> of;  // the number of an object, by its id
    UsedNumbers used;
  };
  struct State {
    AttentionTracker tracker;
    MarkHistory marks{};
    Settings settings{};                  // of its last map
    std::int64_t number = 0, index = -1;  // of the last frame, followed and in the source
    Numbers known{}, numbers{};           // before the last frame, and with its objects
  };

  static int first_unused(const State& state);
  void forget_numbers();
  int first_id_after_cut(const SequenceMemory& other, const Frame& frame) const;
  bool follows(std::int64_t number) const { return before_.number + 1 == number; }

  State before_, now_;
  bool attended_ = false;  // since next_frame()
};

}  // namespace saccade
