#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// Writes packets as the one video track of a Matroska file, as ffmpeg does for a codec that Matroska has no
/// name for: by its four letters. One packet a frame, every `period_ms`.
void write_matroska(const std::filesystem::path& path, std::uint32_t fourcc, cv::Size size, int bits,
                    int period_ms, const std::vector<std::vector<std::uint8_t>>& packets);

/// The same for gray16le pixels, not compressed.
void write_raw_matroska(const std::filesystem::path& path, cv::Size size, int period_ms,
                        const std::vector<std::vector<std::uint8_t>>& packets);

/// One of several video tracks, whose codec Matroska has no name for; without a size, a track of the motion
/// sensor.
struct MatroskaTrack {
  std::string title;
  std::uint32_t fourcc = 0;
  cv::Size size;
  int bits = 16;
  int start_ms = 0, period_ms = 33;
  std::vector<std::vector<std::uint8_t>> packets;
};

struct MatroskaAttachment {
  std::string name;
  std::string content;
};

/// Writes tracks and attached files as the recorder of Azure Kinect does: times in us, and clusters of at
/// most 32 ms with the packets of all tracks in the order of their times.
void write_matroska(const std::filesystem::path& path, const std::vector<MatroskaTrack>& tracks,
                    const std::vector<MatroskaAttachment>& attachments);

}  // namespace saccade
