#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/frame_source.hpp"
#include "pipeline/frame_settings.hpp"
#include "sources/source_options.hpp"

namespace saccade::python {

/// A frame with pixels of its own.
struct SourceFrame {
  Frame frame;
  std::string problem;  ///< why its colour or labels are missing; empty = they are not
};

/// A source that gives its frames one by one, as Python iterates. Any thread that holds the GIL may call;
/// calls wait for one another, without the GIL.
class Source {
 public:
  /// Throws as open_source() and check_start().
  Source(const std::string& uri, const FrameSettings& frames, const SourceOptions& options);

  const SourceInfo& info() const { return info_; }

  /// How many frames next() gives or rejects from the start to the end; unknown for live sensors.
  [[nodiscard]] std::optional<std::int64_t> frame_count() const;

  /// The next frame; none at the end. Frames that cannot be used are noted in rejected(). Lets Ctrl-C through
  /// while it waits. Throws pybind11::value_error after close().
  [[nodiscard]] std::optional<SourceFrame> next();

  /// Index and reason of each frame that could not be used.
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::string>> rejected() const;

  /// Releases the file or sensor.
  void close();

 private:
  std::optional<SourceFrame> next_without_gil();

  mutable std::mutex mutex_;  // guards what follows but info_ and frames_
  std::unique_ptr<FrameSource> source_;
  SourceInfo info_;
  FrameSettings frames_;
  std::int64_t position_ = 0;  // of the source: the frame that it reads next
  std::int64_t wanted_;        // the frame to give next
  std::int64_t taken_ = 0;     // frames given or rejected
  std::vector<std::pair<std::int64_t, std::string>> rejected_;
};

}  // namespace saccade::python
