#pragma once

#include <chrono>

namespace saccade {

/// For FrameSource::read() of recordings, which never wait.
inline constexpr std::chrono::milliseconds kNoWait{0};

}  // namespace saccade
