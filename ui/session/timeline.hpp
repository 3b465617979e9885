#pragma once

#include <cstdint>
#include <vector>

namespace saccade {

/// The strength of the first fixation of every frame that was computed, over the frames of a recording.
class Timeline {
 public:
  struct Entry {
    bool seen = false;
    float strength = 0;
    bool current = false;  ///< computed with the settings of now
  };

  /// Forgets everything. `frames` >= 0: of the recording; 0 = not known, then it grows.
  void reset(std::int64_t frames);
  void add(std::int64_t index, float strength, bool current);
  /// The settings have changed: what is there is not current any more.
  void age();

  const std::vector<Entry>& entries() const { return entries_; }
  /// The largest strength, for the scale: of the current entries if there are any; 0 = nothing yet.
  float largest() const;

 private:
  std::vector<Entry> entries_;
};

/// The frame under a place of a time line that shows `frames` frames over `width` pixels.
std::int64_t frame_at(double x, double width, std::int64_t frames);

/// Where the middle of a frame is on such a time line.
double frame_x(std::int64_t index, double width, std::int64_t frames);

/// The distance between numbered frames, 1, 2 or 5 times a power of ten, so that labels of `label_width`
/// pixels do not touch.
std::int64_t tick_step(double width, std::int64_t frames, double label_width);

}  // namespace saccade
