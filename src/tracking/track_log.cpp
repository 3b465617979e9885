#include "tracking/track_log.hpp"

#include <algorithm>

namespace saccade {

void TrackLog::add(std::int64_t frame, const Attention& attention) {
  if (!attention.sequence) return;
  ++frames_;
  cuts_ += attention.sequence->cut;
  const std::optional<int> gaze = attention.sequence->gaze;
  for (const Fixation& fixation : attention.fixations) {
    const bool known = tracks_.contains(fixation.id);
    if (!known && tracks_.size() >= kMostTracks) {
      unlisted_ += fixation.id > last_id_;
      last_id_ = std::max(last_id_, fixation.id);
      continue;
    }
    last_id_ = std::max(last_id_, fixation.id);
    Track& track = tracks_[fixation.id];
    if (!known) track.first_frame = frame;
    track.last_frame = frame;
    ++track.frames;
    track.looks += gaze == fixation.id && gaze != gaze_;
    track.world_mm = fixation.world_mm;
  }
  gaze_ = gaze;
}

}  // namespace saccade
