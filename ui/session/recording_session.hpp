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

/// How a recording is doing, for people to see.
struct RecordingStatus {
  enum class Phase { idle, recording, closing };
  Phase phase = Phase::idle;
  std::filesystem::path file{};  ///< of this recording or, when idle, of the last one; empty = there was none
  double seconds = 0;            ///< since its start, wall time
  std::uint64_t frames = 0;      ///< written
  std::uint64_t dropped = 0;     ///< because the disk was too slow
  std::uint64_t bytes = 0;
  std::optional<std::uint64_t> free_bytes{};  ///< of the disk; none = not known
  std::string error{};                        ///< why the last one ended early; empty = it did not
};

/// Records what the capture thread sees while a person wants it, to .oni files. start(), stop() and status()
/// are for the thread that draws and never wait for the disk to take frames; offer() is for the capture
/// thread.
class RecordingSession {
 public:
  RecordingSession() = default;
  /// Closes a running recording properly.
  ~RecordingSession();
  RecordingSession(const RecordingSession&) = delete;
  RecordingSession& operator=(const RecordingSession&) = delete;

  /// Begins `file`. Throws Error: it exists, or cannot be made; std::logic_error unless idle.
  void start(const std::filesystem::path& file, const OniWriterOptions& options);

  /// Ends the recording; its file is closed in the background, see status(). Nothing if none is running.
  void stop();

  /// Takes a copy of the frame if a recording is running; drops and counts it if the disk is behind. A frame
  /// that is not later than the one before (after a seek, or a loop) is put `kPeriod_us` after it.
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
  RecordingStatus status_;                // what does not come from recording_
  std::jthread closer_;
};

}  // namespace saccade
