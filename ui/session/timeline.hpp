#pragma once

#include <cstdint>
#include <vector>

namespace saccade {

/// The largest saliency of every computed frame of a recording.
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

/// The frames that a time line shows: from `first` on, `count` of them, both also between frames.
struct VisibleFrames {
  double first = 0, count = 0;
};

/// Which part of a recording the time line shows.
class TimelineZoom {
 public:
  /// Of a recording of `frames` frames; all of them without a zoom.
  [[nodiscard]] VisibleFrames visible(std::int64_t frames) const;
  /// Zooms in by `steps` > 0, out by < 0, about the place at `share` (0..1) of the line; ten frames stay
  /// visible.
  void zoom(double steps, double share, std::int64_t frames);
  /// Moves the visible part by `share` of the line, to later frames for > 0.
  void pan(double share, std::int64_t frames);
  /// Turns over like a page if frame `index` has come since the last call and is not visible.
  void follow(std::int64_t index, std::int64_t frames);
  void reset() { *this = {}; }
  [[nodiscard]] bool zoomed() const { return visible_.count > 0; }

 private:
  void keep_inside(std::int64_t frames);

  VisibleFrames visible_;  // a count of 0 = all
  std::int64_t followed_ = -1;
};

/// A bar of the plot: of one frame, or of those that fall on the same column of pixels.
struct TimelineBar {
  double x = 0;  ///< its middle, pixels
  float strength = 0;
  bool current = false;
};

/// The bars of the visible frames on a line of `width` pixels; where frames share a column, the strongest
/// one, of the current ones if there are any.
[[nodiscard]] std::vector<TimelineBar> timeline_bars(const std::vector<Timeline::Entry>& entries,
                                                     const VisibleFrames& visible, double width);

/// The frame at `x` on a time line of `width` pixels, between the first and the last visible one; 0 without
/// any.
[[nodiscard]] std::int64_t frame_at(double x, double width, const VisibleFrames& visible);

/// The middle of a frame on such a time line, in pixels; outside of 0..width for a frame that is not visible.
[[nodiscard]] double frame_x(std::int64_t index, double width, const VisibleFrames& visible);

/// The step between numbered frames, 1, 2 or 5 times a power of ten, so that labels of `label_width` pixels
/// do not touch.
[[nodiscard]] std::int64_t tick_step(double width, const VisibleFrames& visible, double label_width);

}  // namespace saccade
