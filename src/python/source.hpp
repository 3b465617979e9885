#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/frame_source.hpp"
#include "pipeline/frame_settings.hpp"

namespace saccade::python {

/// A source that gives its frames one by one, as Python iterates. One thread at a time.
class Source {
 public:
  /// Throws as open_source() and check_start().
  Source(const std::string& uri, const FrameSettings& frames, const SensorSettings& sensor);

  const SourceInfo& info() const { return source_->info(); }

  /// How many frames next() gives or rejects from the start to the end; unknown for live sensors.
  [[nodiscard]] std::optional<std::int64_t> frame_count() const;

  /// The next frame, with pixels of its own; empty at the end. Frames that cannot be used are noted in
  /// rejected(). Waits for a live source without the GIL, and lets Ctrl-C through.
  [[nodiscard]] std::optional<Frame> next();

  /// Index and reason of each frame that could not be used.
  const std::vector<std::pair<std::int64_t, std::string>>& rejected() const { return rejected_; }

 private:
  ReadResult read(Frame& frame);

  std::unique_ptr<FrameSource> source_;
  FrameSettings frames_;
  std::int64_t position_ = 0;  // of the source: the frame that it reads next
  std::int64_t wanted_;        // the frame to give next
  std::int64_t taken_ = 0;     // frames given or rejected
  std::vector<std::pair<std::int64_t, std::string>> rejected_;
};

}  // namespace saccade::python
