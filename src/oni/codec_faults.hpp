#pragma once

namespace saccade {

/// Faults that the payloads of all codecs may have.
inline constexpr const char* kTruncated = "the coded data is truncated";
inline constexpr const char* kTooManyPixels = "more pixels than the image has";

}  // namespace saccade
