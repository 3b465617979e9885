#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "oni/recording.hpp"

namespace saccade {

/// What a person wants to know of one stream.
struct OniStreamInfo {
  std::uint32_t node = 0;
  std::string name;
  OniNodeType type{};
  OniCodec codec{};
  std::string pixels;                   ///< e.g. "depth 1 mm"
  std::optional<std::string> unusable;  ///< why its frames cannot be decoded; absent = they can
  cv::Size size;                        ///< full image, px; 0 x 0 = not told
  cv::Rect crop;                        ///< the part that frames hold
  std::uint64_t frames = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t first_us = 0, last_us = 0;  ///< least and largest time
  double nominal_rate_hz = 0;               ///< 0 = not told
  double measured_rate_hz = 0;              ///< 0 = fewer than two frames
  std::uint64_t gaps = 0;            ///< steps of time longer than 1.5 nominal periods (of 30 Hz if not told)
  std::uint64_t largest_gap_us = 0;  ///< the longest step of time
  std::uint64_t backward_steps = 0;  ///< frames that are earlier than the one before
  std::optional<Intrinsics> intrinsics;  ///< of what the file says; absent = it says nothing
  std::uint64_t dropped = 0;             ///< frames that the recorder says it lost

  double duration_s() const { return static_cast<double>(last_us - first_us) / 1e6; }
};

/// What a person wants to know of a recording.
struct OniInfo {
  std::string file;
  std::uint64_t size_bytes = 0;
  std::string version;  ///< of the format
  bool closed = false;  ///< has an END record
  std::uint64_t lost_bytes = 0;
  std::size_t errors = 0;  ///< that the scan found; `check` looks closer
  std::vector<OniStreamInfo> streams;
};

/// Read from the index alone; no frame is decoded.
OniInfo describe(const Recording& recording);

}  // namespace saccade
