#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include <opencv2/core.hpp>

#include "attention/attention.hpp"

namespace saccade {

/// What became of the objects of a sequence: when each was reported, how often it was looked at, where it
/// was.
class TrackLog {
 public:
  /// The life of one object.
  struct Track {
    std::int64_t first_frame = 0, last_frame = 0;  ///< indices of frames that reported it
    std::int64_t frames = 0;                       ///< how many did
    std::int64_t looks = 0;                        ///< how often the gaze turned to it
    cv::Point3f world_mm;                          ///< where it was reported last
  };

  static constexpr std::size_t kMostTracks = 10'000;  ///< later objects are counted, not listed

  /// Takes the attention of the next frame. Does nothing without a sequence.
  void add(std::int64_t frame, const Attention& attention);

  bool empty() const { return frames_ == 0; }
  const std::map<int, Track>& tracks() const { return tracks_; }  ///< by id
  std::int64_t unlisted() const { return unlisted_; }             ///< objects beyond kMostTracks
  std::int64_t cuts() const { return cuts_; }

 private:
  std::map<int, Track> tracks_;
  std::int64_t frames_ = 0, cuts_ = 0, unlisted_ = 0;
  int last_id_ = 0;
  std::optional<int> gaze_;
};

}  // namespace saccade
