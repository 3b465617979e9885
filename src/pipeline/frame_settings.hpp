#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/intrinsics.hpp"
#include "core/setting.hpp"

namespace saccade {

/// Which frames of a source are used, and with which camera.
struct FrameSettings {
  std::int64_t start = 0;                  ///< index of the first
  std::int64_t every = 1;                  ///< use every n-th from there, >= 1
  std::int64_t frames = 0;                 ///< at most this many; 0 = all
  std::optional<Intrinsics> intrinsics{};  ///< instead of the source's
};

std::vector<SettingOf<FrameSettings>> frame_setting_specs();

/// The number of frames that start, every and frames select of a source with `count` frames; 0 if `start` is
/// past the last one.
std::int64_t selected_frames(const FrameSettings& settings, std::int64_t count);

}  // namespace saccade
