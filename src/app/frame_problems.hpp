#pragma once

#include <cstdint>
#include <mutex>
#include <string>

namespace saccade {

/// Counts frames with a problem and keeps the reason of the first. Any thread.
class FrameProblems {
 public:
  void add(std::int64_t index, const std::string& reason);

  std::int64_t count() const;
  /// "frame 7: why"; empty if there is none.
  std::string first() const;

 private:
  mutable std::mutex mutex_;
  std::int64_t count_ = 0, first_index_ = 0;
  std::string first_reason_;
};

/// Warns of frames that lack colour or labels, if there are any.
void report_incomplete(const std::string& source, const FrameProblems& frames);

}  // namespace saccade
