#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/frame_source.hpp"

namespace saccade {

/// Reports changes of a source's state while it is read: the device was lost, or reconnected, or did not
/// apply a setting. Checks the state only after a read that waited, so that a frame in time costs nothing.
/// For the thread that reads.
class SourceStateNotifier {
 public:
  /// `report` may be empty. It gets the notes only if they differ from those of the last report, or at first
  /// from those of info().
  SourceStateNotifier(const FrameSource& source, std::function<void(const SourceState&)> report)
      : source_(source),
        report_(std::move(report)),
        waited_(source.state().connection != SourceState::Connection::streaming),
        notes_(source.info().notes) {}

  /// After each read(), with what it gave.
  void after_read(ReadStatus status) {
    const bool waited = std::exchange(waited_, status == ReadStatus::timeout);
    if (!report_ || (!waited && !waited_)) return;
    SourceState state = source_.state();
    const bool moved = std::exchange(connection_, state.connection) != state.connection;
    if (state.connection != SourceState::Connection::streaming || state.notes == notes_)
      state.notes.clear();
    else
      notes_ = state.notes;
    if (moved || !state.notes.empty()) report_(state);
  }

 private:
  const FrameSource& source_;
  const std::function<void(const SourceState&)> report_;
  bool waited_;                                                              // the last read() gave no frame
  SourceState::Connection connection_ = SourceState::Connection::streaming;  // of the last report
  std::vector<std::string> notes_;  // of the last report that had any
};

}  // namespace saccade
