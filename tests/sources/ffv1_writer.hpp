#pragma once

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

struct Ffv1Options {
  int level = 3;          ///< version of the format; 1 has no checksums
  bool slice_crc = true;  ///< of version 3
  int key_every = 1;      ///< distance of key frames
  int rate_hz = 30;
  bool container_crc = true;
};

/// Writes images as FFV1 gray16le, by libavcodec and libavformat; the ending of the name decides the
/// container.
void write_ffv1(const std::filesystem::path& path, const std::vector<cv::Mat1w>& images,
                const Ffv1Options& options = {});

}  // namespace saccade
