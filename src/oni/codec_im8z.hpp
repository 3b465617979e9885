#pragma once

#include <cstdint>
#include <span>

namespace saccade {

/// What came out of an Im8z payload.
struct [[nodiscard]] DecodedIm8z {
  std::size_t bytes = 0;        ///< written
  const char* fault = nullptr;  ///< what is wrong with the payload; nullptr = it is whole
};

/// Decodes the 8-bit codec of OpenNI: any bytes, mostly grey images. Reads and writes within its arguments,
/// whatever the payload holds. More bytes than fit is a fault; fewer is not, the caller compares the count.
DecodedIm8z decode_im8z(std::span<const std::uint8_t> payload, std::span<std::uint8_t> bytes);

/// False if a payload cannot possibly hold so many bytes, since one of its bytes gives at most 30.
constexpr bool may_hold_im8z(std::size_t payload, std::size_t bytes) { return bytes / 30 <= payload; }

}  // namespace saccade
