#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/frame_source.hpp"

namespace saccade {

/// Notices what is new of a source that is read: its device is lost, or back, or does something otherwise
/// than asked. Looks only where the source has waited, so that a frame that comes in time costs nothing.
/// For the thread that reads.
class SourceStateNotifier {
 public:
  /// `tell` may be empty. It gets notes only where they are not those that it got last; at first, those of
  /// info().
  SourceStateNotifier(const FrameSource& source, std::function<void(const SourceState&)> tell)
      : source_(source),
        tell_(std::move(tell)),
        waited_(source.state().connection != SourceState::Connection::streaming),
        notes_(source.info().notes) {}

  /// After each read(), with what it gave.
  void after_read(ReadStatus status) {
    const bool waited = std::exchange(waited_, status == ReadStatus::timeout);
    if (!tell_ || (!waited && !waited_)) return;
    SourceState state = source_.state();
    const bool moved = std::exchange(connection_, state.connection) != state.connection;
    if (state.connection != SourceState::Connection::streaming || state.notes == notes_)
      state.notes.clear();
    else
      notes_ = state.notes;
    if (moved || !state.notes.empty()) tell_(state);
  }

 private:
  const FrameSource& source_;
  const std::function<void(const SourceState&)> tell_;
  bool waited_;                                                              // the last read() gave nothing
  SourceState::Connection connection_ = SourceState::Connection::streaming;  // as told
  std::vector<std::string> notes_;                                           // likewise
};

}  // namespace saccade
