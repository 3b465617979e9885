#pragma once

#include <cstdint>
#include <span>

namespace saccade {

/// Decompresses LZF data, which must fill `output` exactly and be used up by that. Returns false otherwise;
/// never reads or writes outside of the two, whatever the data.
bool lzf_decompress(std::span<const std::uint8_t> input, std::span<std::uint8_t> output);

}  // namespace saccade
