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

inline constexpr double kDefaultRateHz = 30;  ///< of a source or a stream that names none

/// Properties of a source, known when it has been opened.
struct SourceInfo {
  std::string uri;                          ///< as the user named it
  std::string kind;                         ///< "synthetic", "folder", "tum", "oni", ...
  cv::Size size;                            ///< of every frame: W x H
  std::optional<std::int64_t> frame_count;  ///< unknown for live sensors
  double rate_hz = 0;                       ///< nominal; 0 = unknown
  Intrinsics intrinsics;
  /// mm of one unit of the depth as the source stores it: depth is the float nearest to an integer below
  /// 65535 times this, and so can be stored again exactly. 0 = real numbers, or not known.
  double depth_unit_mm = 0;
  bool has_depth = true;  ///< false: a plain camera or video, whose depth never has a reading
  bool live = false;      ///< the source sets the time of each frame, and no frame can be read twice
  bool sequence = false;  ///< each frame shows the scene of the one before it a moment later
  /// For the user to know, such as gaps and guesses; one line each. Those of a live sensor are as of its
  /// opening.
  std::vector<std::string> notes;
};

/// Throws Error (usage) if frame `start` is past the last one of the source.
void check_start(const SourceInfo& source, std::int64_t start);

enum class ReadStatus {
  frame,     ///< `frame` is filled
  end,       ///< there are no more frames
  timeout,   ///< no frame came in time; try again (live sources only)
  rejected,  ///< this frame cannot be used, for `reason`; the next may be good
};

struct [[nodiscard]] ReadResult {
  ReadStatus status = ReadStatus::end;
  std::string reason;
};

/// The present state of a live source, for display.
struct SourceState {
  enum class Connection {
    streaming,  ///< frames come, or are expected to
    waiting,    ///< the device is not connected yet
    lost,       ///< the device was disconnected or sends no frames; the source tries to reconnect
  };
  Connection connection = Connection::streaming;
  std::string text{};  ///< one line: what the source waits for, or how the device was lost
  std::chrono::steady_clock::time_point since{};  ///< beginning of this state
  std::int64_t losses = 0;                        ///< number of dropouts until now
  double away_s = 0;                              ///< total duration of the dropouts
  std::int64_t colourless = 0;  ///< frames for which a device with a colour stream gave no colour in time
  std::vector<std::string> notes{};  ///< settings that the device did not apply, one line each
};

/// A sensor, a recording, a folder of images or a synthetic scene. Thread safety: one thread at a time calls
/// read() and seek(); any thread may call state() and interrupt().
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual const SourceInfo& info() const = 0;

  /// Reads the next frame into `frame`, reusing its memory and replacing all of its fields. Waits at most
  /// `timeout`, which matters to live sources only. Throws Error if reading cannot continue.
  virtual ReadResult read(Frame& frame, std::chrono::milliseconds timeout) = 0;

  /// The next read() gives frame `index`, or end if there is none. Throws std::logic_error for a live source.
  virtual void seek(std::int64_t index) = 0;

  /// Of interest for live sources.
  virtual SourceState state() const { return {}; }

  /// The controls of an open sensor; nullptr for other sources.
  virtual SensorControls* controls() { return nullptr; }

  /// Makes a waiting read() return soon, with timeout.
  virtual void interrupt() noexcept {}
};

}  // namespace saccade
