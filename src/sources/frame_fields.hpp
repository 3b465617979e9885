#pragma once

#include <cstddef>
#include <cstdint>

#include "core/frame_source.hpp"

namespace saccade {

/// The note in SourceInfo of a source of images without depth.
inline constexpr const char* kNoDepthNote =
    "it has no depth: only the models of the image work, and lengths are unknown";

/// Problems of a file that notes in SourceInfo name one by one; another note counts the rest.
inline constexpr std::size_t kMostNotes = 5;

/// Fills the fields that are alike for every frame of a video, images or a camera: no name, no truth.
inline void begin_frame(Frame& frame, const SourceInfo& info, std::int64_t index) {
  frame.index = index;
  frame.name.clear();
  frame.intrinsics = info.intrinsics;
  frame.truth = {};
}

/// Depth without a reading.
inline void set_no_depth(Frame& frame, cv::Size size) {
  frame.depth_mm.create(size);
  frame.depth_mm.setTo(0);
}

}  // namespace saccade
