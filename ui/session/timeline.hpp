#pragma once

#include <cstdint>
#include <vector>

namespace saccade {

/// The saliency of the strongest fixation of every computed frame of a recording.
class Timeline {
 public:
  struct Entry {
    bool seen = false;  ///< computed at all
    float strength = 0;
    bool current = false;  ///< computed with the present settings
  };

  /// Starts again with a recording of `frames` >= 0 frames; 0 = not known, it grows then.
  void reset(std::int64_t frames);
  void add(std::int64_t index, float strength, bool current);
  /// The settings have changed: no entry is current any more.
  void age();

  const std::vector<Entry>& entries() const { return entries_; }
  /// The largest strength, for the scale: of the current entries if there are any; 0 = nothing yet.
  [[nodiscard]] float largest() const;

 private:
  std::vector<Entry> entries_;
};

/// The frame at `x` on a time line that shows `frames` frames over `width` pixels.
[[nodiscard]] std::int64_t frame_at(double x, double width, std::int64_t frames);

/// The middle of a frame on such a time line, in pixels.
[[nodiscard]] double frame_x(std::int64_t index, double width, std::int64_t frames);

/// The step between numbered frames, 1, 2 or 5 times a power of ten, so that labels of `label_width` pixels
/// do not touch.
[[nodiscard]] std::int64_t tick_step(double width, std::int64_t frames, double label_width);

}  // namespace saccade
