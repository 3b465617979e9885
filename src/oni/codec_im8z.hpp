#pragma once

#include <cstdint>
#include <span>

namespace saccade {

/// The result of decoding a payload.
struct [[nodiscard]] DecodedIm8z {
  std::size_t bytes = 0;        ///< number written
  const char* fault = nullptr;  ///< the fault of the payload; nullptr = none
};

/// Decodes the 8-bit codec (README 4.3), mostly of grey images. Decodes any payload without access outside
/// its arguments. More bytes than fit are a fault. Fewer are not: the caller compares the number.
DecodedIm8z decode_im8z(std::span<const std::uint8_t> payload, std::span<std::uint8_t> bytes);

/// False if a payload of `payload` bytes is too short for `bytes`: a byte holds at most 30.
constexpr bool may_hold_im8z(std::size_t payload, std::size_t bytes) { return bytes / 30 <= payload; }

}  // namespace saccade
