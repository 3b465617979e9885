#pragma once

#include <cstdint>
#include <span>

namespace saccade {

/// Decompresses LZF data, all of which must fill `output` exactly; false otherwise. Never reads or writes
/// outside of the two, whatever the data.
[[nodiscard]] bool lzf_decompress(std::span<const std::uint8_t> input, std::span<std::uint8_t> output);

}  // namespace saccade
