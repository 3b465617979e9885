#pragma once

#include <mutex>
#include <optional>

#include "core/file.hpp"
#include "output/frame_exporter.hpp"

namespace saccade {

/// Frames as a sequence of TUM RGB-D: depth/NNNNNN.png and rgb/NNNNNN.png, their lists depth.txt and rgb.txt
/// with the times in seconds, groundtruth.txt if a frame has a pose, and meta.json. Depth is in the
/// unit of that format, 1/5 mm, if it holds the depth of the first frame exactly, else in the source's.
class TumWriter final : public FrameExporter {
 public:
  TumWriter(std::filesystem::path folder, SourceInfo info);

  void add(const Frame& frame) override;
  void write(const Frame& frame) override;
  void finish() override;
  DepthLosses losses() const override;

 private:
  void begin(const Frame& frame);
  void add_pose(const std::string& time, const cv::Affine3d& pose);

  std::filesystem::path folder_;
  SourceInfo info_;
  double unit_mm_ = 0;
  std::optional<LineFile> depth_list_, colour_list_, poses_;
  mutable std::mutex mutex_;
  DepthLosses losses_;  // guarded by mutex_
};

}  // namespace saccade
