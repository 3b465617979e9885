#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

#include "attention/attention_settings.hpp"
#include "attention/confidence.hpp"
#include "core/intrinsics.hpp"
#include "core/worker_pool.hpp"

namespace saccade {

/// What a fixation's proto-object is like in space; of the `proto` selector only.
struct ProtoObject {
  int pixels = 0;           ///< of its mask
  cv::Point3f centroid_mm;  ///< mean of its points, camera frame
  cv::Point3f extent_mm;    ///< side lengths of its axis-aligned box in camera frame
};

/// One attention point.
struct Fixation {
  int row = 0, col = 0;      ///< pixel of level 0
  float saliency = 0;        ///< of the master map at that pixel; over time, of its object
  cv::Point3f position_mm;   ///< the point there, camera frame; (0,0,0) = no reading there
  ProtoObject proto_object;  ///< pixels = 0: none was grown
  /// Probability that the point lies on an object, 0..1; none: the selector does not estimate it (`wta`).
  std::optional<float> confidence{};

  // Of attention over time (src/tracking)
  int id = 0;              ///< of the object, the same in all frames; 0 = frames are taken one by one
  int age_frames = 0;      ///< in how many frames the object has been seen, this one among them
  cv::Point3f world_mm{};  ///< the point in the world of SequenceState
};

/// Where a frame stands in its sequence.
struct SequenceState {
  std::optional<int> gaze;  ///< id of the object that is looked at; none = there is none
  bool cut = false;         ///< nothing links the frame to those before it: the memory has begun again
  cv::Affine3d
      camera_to_world;  ///< mm; the world is the camera frame of the first frame, or of the first after a cut
};

/// Whether the point lies more probably on nothing than on an object.
inline bool is_doubtful(const Fixation& fixation) {
  return fixation.confidence && *fixation.confidence < kProbablyObject;
}

/// The attention points of one frame, most salient first.
struct Attention {
  std::vector<Fixation> fixations;
  std::optional<SequenceState> sequence;  ///< of attention over time only
  std::string ended_early;                ///< why there are fewer than were asked for; empty = there are not
  cv::Mat1w masks;  ///< H x W, rank (1..) of the fixation whose proto-object holds the pixel, 0 = none; of
                    ///< the `wta` selector all 0
};

/// Chooses attention points in a saliency map (README.md). Keeps memory between frames.
/// Thread safety: one select() at a time per object.
class AttentionSelector {
 public:
  virtual ~AttentionSelector() = default;

  /// saliency: H x W, finite, >= 0. depth_mm: H x W, 0 = no reading, finite, never negative. Overwrites
  /// `attention` whole, reusing its memory. The same input gives the same output, whatever came before. No
  /// two fixations are at one pixel; there may be fewer than asked for, and then ended_early says why. Throws
  /// std::invalid_argument if the images are empty or of different sizes, or the camera is not valid.
  virtual void select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
                      Attention& attention) = 0;
};

/// The selector that `settings` asks for: ProtoSelector (attention/proto.hpp) or WtaSelector
/// (attention/wta.hpp). Throws std::invalid_argument for a number of fixations or a focus that they cannot
/// use.
std::unique_ptr<AttentionSelector> make_selector(const AttentionSettings& settings);

}  // namespace saccade
