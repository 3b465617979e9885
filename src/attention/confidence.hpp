#pragma once

namespace saccade {

/// What is known about a fixation beside its place (README.md, section 7).
struct ConfidenceCues {
  float front_share = 0;             ///< of its segment, 0..1 (BorderOwnership); 0 without a segment
  float relative_saliency = 1;       ///< of its cell's value to that of the frame's first fixation, above 0
  bool on_supporting_plane = false;  ///< its segment is a table, floor or wall
  bool without_segment = false;      ///< too few cells around it make a surface
};

/// Least confidence of a fixation that lies more probably on an object than on nothing.
inline constexpr float kProbablyObject = 0.5F;

/// The probability that a fixation lies on an object, 0..1: a logistic regression on the cues.
[[nodiscard]] float confidence(const ConfidenceCues& cues);

}  // namespace saccade
