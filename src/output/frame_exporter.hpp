#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "core/depth_units.hpp"
#include "core/frame.hpp"
#include "core/frame_source.hpp"

namespace saccade {

/// Writes the frames of a source in a format that other programs read. All functions throw Error (failed).
class FrameExporter {
 public:
  virtual ~FrameExporter() = default;

  /// Notes a frame, in the order of the frames. One thread.
  virtual void add(const Frame& frame) = 0;

  /// Writes the images of a frame that was added. Any thread, for different frames at the same time.
  virtual void write(const Frame& frame) = 0;

  /// Completes the files, after the last frame; also after an interruption.
  virtual void finish() = 0;

  /// Depth that the format did not keep exactly, so far.
  virtual DepthLosses losses() const = 0;
};

/// A format of `saccade export`.
struct ExportFormat {
  std::string_view name, help;
  /// Writes into `folder`, which exists. `info`: that of the source.
  std::unique_ptr<FrameExporter> (*make)(const std::filesystem::path& folder, const SourceInfo& info);
};

/// All formats, in the order of the help.
std::span<const ExportFormat> export_formats();

}  // namespace saccade
