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

/// The same uncompressed, as gray16le or gray16be at 30 Hz.
void write_raw_grey(const std::filesystem::path& path, const std::vector<cv::Mat1w>& images, bool big_endian);

struct Mpeg4Options {
  int key_every = 1, b_frames = 0;
  bool container_crc = true;
  int turned_degrees = 0;  ///< as a phone notes how it was held; clockwise
};

/// Writes images of grey (16 = black, 235 = white) as MPEG-4 at 30 Hz.
void write_mpeg4(const std::filesystem::path& path, const std::vector<cv::Mat1b>& images,
                 const Mpeg4Options& options = {});

}  // namespace saccade
