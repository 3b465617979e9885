#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "attention/attention.hpp"
#include "attention/frame_surfaces.hpp"
#include "attention/proto_objects.hpp"
#include "core/frame.hpp"
#include "tracking/attention_order.hpp"
#include "tracking/camera_motion.hpp"
#include "tracking/colour_patches.hpp"
#include "tracking/gaze.hpp"
#include "tracking/object_memory.hpp"
#include "tracking/object_merging.hpp"
#include "tracking/object_parts.hpp"
#include "tracking/object_shapes.hpp"
#include "tracking/surface_memory.hpp"
#include "tracking/tracking_settings.hpp"

namespace saccade {

/// Attention over time: ProtoSelector with a memory. A pure function of the frames so far: no threads, no
/// clocks. A copy goes on from the same memory. Keeps its memory between frames. Thread safety: one call at a
/// time per object.
class AttentionTracker {
 public:
  /// How far the mean over time of an object's confidence must be from the confidence reported for it to be
  /// reported itself, and how far below the threshold for an object that was reported to be left out. So an
  /// object does not come and go because its confidence is near the limit.
  static constexpr float kConfidenceMargin = 0.1F;
  static constexpr double kConfidence_s = 2;  ///< time of that mean
  /// How far a fixation is from the border of its object, where its anchor allows it.
  static constexpr int kInside_px = 2;

  /// fixations: the greatest number per frame. min_confidence: 0..1, objects below it are remembered but not
  /// reported. Throws std::invalid_argument unless there is at least one fixation.
  AttentionTracker(int fixations, double min_confidence, const TrackingSettings& settings);

  /// The same settings as those of the constructor, from the next frame on.
  void configure(int fixations, double min_confidence, const TrackingSettings& settings);

  /// The next map is not comparable with those so far (another model): means over time begin again with it.
  /// Objects, their order and the gaze stay.
  void forget_evidence();

  /// The id that the next new object gets.
  int next_id() const { return objects_.next_id(); }

  /// Before a frame that is a cut: its objects are numbered from `first`, >= 1. So two trackers of the same
  /// frames number alike, and a sequence that begins again has the ids that it had.
  void number_from(int first) { objects_.number_from(first); }

  /// Chooses the attention points of the next frame. `surfaces` are the frame's, `step` is how the camera
  /// has moved (CameraMotion). Times of frames must not decrease without a cut. `saliency` and
  /// `attention` as in AttentionSelector::select(); besides, sets each fixation's id, age and place in the
  /// world, and Attention::sequence. A fixation's saliency is that of its object: the map at the object's
  /// strongest place, averaged over time as the evidence.
  void attend(const Frame& frame, const cv::Mat1f& saliency, const FrameSurfaces& surfaces,
              const CameraStep& step, Attention& attention);

  const ObjectMemory& objects() const { return objects_; }

 private:
  void leave_new_parts_out(const Frame& frame, const SurfaceGrid& grid);
  void judge(const AttentionOrder::View& view, const FrameSurfaces& surfaces);
  float confidence_to_report(const TrackedObject& object) const;
  float saliency_of(const AttentionOrder::View& view, const TrackedObject& object) const;
  void report(const AttentionOrder::View& view, Attention& attention);
  const std::vector<int>& cells_of_thing(const TrackedObject& object);
  cv::Point point_of(const AttentionOrder::View& view, const TrackedObject& object) const;
  bool is_inside(const AttentionOrder::View& view, const TrackedObject& object, double depth_mm,
                 cv::Point pixel) const;
  void look(std::int64_t time_us, const std::vector<std::size_t>& chosen, SequenceState& sequence);

  int fixations_ = 1;
  double min_confidence_ = 0;
  std::optional<std::int64_t> last_us_;
  std::vector<float> scratch_, smooth_, values_;
  std::vector<int> thing_cells_;
  SurfaceSegments segments_;  // of the frame, and what colour cuts out of them
  ColourPatches patches_;
  SurfaceMemory memory_;
  ObjectMemory objects_;
  ObjectShapes shapes_;
  ObjectMerging merging_;
  ObjectParts parts_;
  ProtoObjects proto_objects_;
  AttentionOrder order_;
  Gaze gaze_;
  std::vector<std::size_t> chosen_, reported_;  // slots, in order
  std::vector<Gaze::Target> targets_;
};

}  // namespace saccade
