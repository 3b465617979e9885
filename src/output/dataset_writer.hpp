#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/depth_units.hpp"
#include "core/file.hpp"
#include "core/frame.hpp"
#include "core/frame_source.hpp"

namespace saccade {

/// "000012_depth.png": a file of this frame.
std::string frame_file(std::int64_t index, std::string_view ending);

/// Writes the meta.json from which readers of `folder` know how its frames are stored: the camera, unless it
/// is a guess, `depth_unit_mm` unless it is 0, size, rate and source. Throws Error (failed).
void write_meta(const std::filesystem::path& folder, const SourceInfo& info, const Frame& first,
                double depth_unit_mm);

/// The number and time of each frame, a line each: as read_times() reads it.
class TimesWriter {
 public:
  /// Throws Error (failed).
  explicit TimesWriter(const std::filesystem::path& file);
  void add(const Frame& frame);
  /// After the last frame. Throws Error (failed) if the file was deleted meanwhile.
  void finish() const { file_.check_in_place(); }

 private:
  LineFile file_;
};

/// Writes frames as a folder of numbered images that is a source again, equal to the bit and with the times
/// of the frames: NNNNNN_depth.png (16 bits), NNNNNN_rgb.png, NNNNNN_label.png, NNNNNN_class.png, meta.json,
/// times.txt, and poses.txt if a frame has a pose. Depth is stored in the source's unit; without
/// one, in that of unit_for(), and depth that is no multiple is rounded. All functions throw Error (failed).
class DatasetWriter {
 public:
  DatasetWriter(std::filesystem::path folder, SourceInfo info);

  /// Notes a frame before its images are written; in the order of the frames, one thread.
  void add(const Frame& frame);

  /// Write one image of a frame that was added, if the frame has it. Any thread, for different frames at the
  /// same time.
  void write_depth(const Frame& frame);
  void write_colour(const Frame& frame) const;
  void write_truth(const Frame& frame) const;

  /// After the last frame.
  void finish() const;

  double depth_unit_mm() const { return unit_mm_; }
  /// Depth that was not stored exactly, so far. Any thread.
  DepthLosses losses() const;

 private:
  void add_pose(const std::optional<cv::Affine3d>& pose);

  std::filesystem::path folder_;
  SourceInfo info_;
  double unit_mm_ = 0;  // 0 = no frame has been added
  std::optional<TimesWriter> times_;
  std::optional<LineFile> poses_;
  std::int64_t added_ = 0;  // frames
  mutable std::mutex mutex_;
  DepthLosses losses_;  // guarded by mutex_
};

}  // namespace saccade
