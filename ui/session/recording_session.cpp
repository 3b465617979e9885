#include "ui/session/recording_session.hpp"

#include <stdexcept>
#include <utility>

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Phase = RecordingStatus::Phase;

constexpr std::size_t kQueueFrames = 30;  // one second at 30 Hz, while the disk is busy

std::string message_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& exception) {
    return exception.what();
  }
}

}  // namespace

RecordingSession::Recording::Recording(const fs::path& file, const OniWriterOptions& options)
    : writer(file, options), recorder(writer, kQueueFrames) {}

RecordingSession::~RecordingSession() { stop(); }

void RecordingSession::start(const fs::path& file, const OniWriterOptions& options) {
  const std::lock_guard lock(mutex_);
  if (status_.phase != Phase::idle) throw std::logic_error("RecordingSession: a recording is running");
  recording_ = std::make_unique<Recording>(file, options);
  status_ = {.phase = Phase::recording, .file = file, .error = ""};
}

void RecordingSession::stop() {
  const std::lock_guard lock(mutex_);
  if (recording_) close_in_background(std::move(recording_));
}

void RecordingSession::offer(const Frame& frame) noexcept {
  const std::lock_guard lock(mutex_);
  if (!recording_) return;
  Recording& recording = *recording_;
  try {
    Frame timed = frame;
    timed.timestamp_us += recording.shift_us;
    if (recording.last_us && timed.timestamp_us <= *recording.last_us) {
      recording.shift_us += *recording.last_us + kPeriod_us - timed.timestamp_us;
      timed.timestamp_us = *recording.last_us + kPeriod_us;
    }
    recording.last_us = timed.timestamp_us;
    recording.recorder.offer(timed);
  } catch (...) {
    status_.error = message_of(std::current_exception());
    close_in_background(std::move(recording_));
  }
}

// With mutex_ held. The closing thread takes the mutex only at its end.
void RecordingSession::close_in_background(std::unique_ptr<Recording> recording) {
  note(*recording, status_);
  status_.phase = Phase::closing;
  closer_ = std::jthread([this, closing = std::shared_ptr<Recording>(std::move(recording))] {
    std::string error;
    try {
      closing->recorder.finish();
    } catch (...) {
      error = message_of(std::current_exception());
    }
    const std::lock_guard lock(mutex_);
    note(*closing, status_);
    if (status_.error.empty()) status_.error = error;  // else the first one stays
    status_.phase = Phase::idle;
  });
}

void RecordingSession::note(const Recording& recording, RecordingStatus& status) const {
  const OniWriterCounts counts = recording.recorder.counts();
  status.frames = counts.frames;
  status.dropped = counts.dropped;
  status.bytes = recording.recorder.size_bytes();
  if (status.phase == Phase::recording)
    status.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - recording.begin).count();
}

RecordingStatus RecordingSession::status() const {
  const std::lock_guard lock(mutex_);
  RecordingStatus status = status_;
  if (recording_) note(*recording_, status);
  return status;
}

}  // namespace saccade
