#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "oni/recording.hpp"

namespace saccade {

/// The description of one stream.
struct OniStreamInfo {
  std::uint32_t node = 0;
  std::string name;
  OniNodeType type{};
  OniCodec codec{};
  std::string pixels;                   ///< e.g. "depth 1 mm"
  std::optional<std::string> unusable;  ///< why its frames cannot be decoded; absent = they can
  cv::Size size;                        ///< full image, px; 0 x 0 = unknown
  cv::Rect crop;                        ///< the part that frames hold, px
  std::uint64_t frames = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t first_us = 0, last_us = 0;  ///< smallest and largest time
  double nominal_rate_hz = 0;               ///< 0 = unknown
  double measured_rate_hz = 0;              ///< 0 = fewer than two frames
  std::uint64_t gaps = 0;            ///< steps of time longer than 1.5 nominal periods (of 30 Hz if unknown)
  std::uint64_t largest_gap_us = 0;  ///< the longest step of time
  std::uint64_t backward_steps = 0;  ///< frames with an earlier time than the one before
  std::optional<Intrinsics> intrinsics;  ///< of the first frame; absent = the file has none
  std::uint64_t dropped = 0;             ///< frames that the recorder captured and did not write

  double duration_s() const { return static_cast<double>(last_us - first_us) / 1e6; }
};

/// The description of a recording.
struct OniInfo {
  std::string file;
  std::uint64_t size_bytes = 0;
  std::string version;  ///< of the format
  bool closed = false;  ///< has an END record
  std::uint64_t lost_bytes = 0;
  std::size_t errors = 0;  ///< that the scan found; check_recording() finds more
  std::vector<OniStreamInfo> streams;
};

/// Describes a recording from its index alone; decodes no frame.
OniInfo describe(const Recording& recording);

}  // namespace saccade
