#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/frame.hpp"
#include "core/sensor_controls.hpp"

namespace saccade {

/// What a source says of itself when it is opened.
struct SourceInfo {
  std::string uri;                          ///< as the user named it
  std::string kind;                         ///< "synthetic", "folder", "tum", "oni", ...
  cv::Size size;                            ///< of every frame: W x H
  std::optional<std::int64_t> frame_count;  ///< unknown for live sensors
  double rate_hz = 0;                       ///< nominal; 0 = unknown
  Intrinsics intrinsics;
  bool has_depth = true;  ///< false: a plain camera or video, whose depth never has a reading
  bool live = false;      ///< frames come when they come; nothing can be read twice
  /// What the user should know: gaps, guesses; one line each. Of a live sensor as it was opened.
  std::vector<std::string> notes;
};

/// Throws Error (usage) if frame `start` is behind the last one of the source.
void check_start(const SourceInfo& source, std::int64_t start);

enum class ReadStatus {
  frame,     ///< `frame` is filled
  end,       ///< there is nothing more
  timeout,   ///< nothing came in time; try again (live sources only)
  rejected,  ///< this frame cannot be used; `reason` says why, the next may be good
};

struct ReadResult {
  ReadStatus status = ReadStatus::end;
  std::string reason;
};

/// How a live source is doing right now, for people to see.
struct SourceState {
  enum class Connection {
    streaming,  ///< frames come, or nothing speaks against it
    waiting,    ///< the device is not there yet
    lost,       ///< the device was there and is gone, or is silent; the source tries again
  };
  Connection connection = Connection::streaming;
  std::string text{};  ///< one line for the user: what is waited for, or how the device was lost
  std::chrono::steady_clock::time_point since{};  ///< of this state
  std::int64_t losses = 0;                        ///< so far
  double away_s = 0;                              ///< time without the device so far, in all losses
  std::int64_t colourless = 0;  ///< frames so far for which the device, which has colour, gave none in time
  std::vector<std::string> notes{};  ///< what the device that is there does otherwise than asked; a line each
};

/// Where frames come from: a sensor, a recording, a folder, a synthetic scene.
/// Thread safety: one thread at a time calls read() and seek(), except interrupt(), which any thread may
/// call.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual const SourceInfo& info() const = 0;

  /// Reads the next frame into `frame`, reusing its memory; on return all of its fields are this frame's.
  /// Waits at most `timeout`, which matters to live sources only. Throws Error if reading cannot go on.
  virtual ReadResult read(Frame& frame, std::chrono::milliseconds timeout) = 0;

  /// The next read() gives frame `index`, or end if there is none. Throws std::logic_error for a live source.
  virtual void seek(std::int64_t index) = 0;

  /// How the source is doing; of interest for live sources. Any thread.
  virtual SourceState state() const { return {}; }

  /// What can be changed on an open sensor; nullptr for other sources.
  virtual SensorControls* controls() { return nullptr; }

  /// Makes a read() that waits return soon, with timeout.
  virtual void interrupt() noexcept {}
};

}  // namespace saccade
