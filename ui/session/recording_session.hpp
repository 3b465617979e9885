#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/frame.hpp"
#include "oni/recorder.hpp"
#include "oni/writer.hpp"

namespace saccade {

/// The state of a recording, for display.
struct RecordingStatus {
  enum class Phase { idle, recording, closing };
  Phase phase = Phase::idle;
  std::filesystem::path file{};  ///< of this recording or, when idle, of the last one; empty = none yet
  double seconds = 0;            ///< since its start, wall time
  std::uint64_t frames = 0;      ///< written
  std::uint64_t dropped = 0;     ///< the disk was too slow for them
  std::uint64_t bytes = 0;
  std::string error{};  ///< why the last one ended early; empty = it did not
};

/// Records the frames of the capture thread to .oni files. The thread that draws calls start(), stop() and
/// status(), which never wait for frames to be written; the capture thread calls offer().
class RecordingSession {
 public:
  RecordingSession() = default;
  /// Closes a running recording.
  ~RecordingSession();
  RecordingSession(const RecordingSession&) = delete;
  RecordingSession& operator=(const RecordingSession&) = delete;

  /// Creates `file`. Throws Error if it exists or cannot be created; std::logic_error unless idle.
  void start(const std::filesystem::path& file, const OniWriterOptions& options);

  /// Ends the recording and closes its file in the background, see status(). Does nothing if none is running.
  void stop();

  /// Copies the frame if a recording is running; drops and counts it if the disk is behind. Stores a frame
  /// that is not later than the one before (after a seek or a loop) `kPeriod_us` after it.
  void offer(const Frame& frame) noexcept;

  RecordingStatus status() const;

  static constexpr std::int64_t kPeriod_us = 33'333;

 private:
  struct Recording {
    Recording(const std::filesystem::path& file, const OniWriterOptions& options);
    OniWriter writer;
    OniRecorder recorder;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    std::optional<std::int64_t> last_us;  // as stored
    std::int64_t shift_us = 0;            // from the source's time to the stored one
  };

  void close_in_background(std::unique_ptr<Recording> recording);
  void note(const Recording& recording, RecordingStatus& status) const;

  mutable std::mutex mutex_;
  std::unique_ptr<Recording> recording_;  // guarded by mutex_, as is all below
  RecordingStatus status_;                // without the part that comes from recording_
  std::jthread closer_;
};

}  // namespace saccade
