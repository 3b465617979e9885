#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace saccade {

/// Decompresses `data` into `out`, replacing it. `method`: "" or "none", "lz4" (frame format), "zstd", "bz2".
/// `size`: what the data must become; memory grows with the data that are really there, not with this number.
/// Throws std::runtime_error with the reason: unknown method, damaged, another size, more than 512 MB.
void decompress(std::string_view method, std::span<const std::uint8_t> data, std::uint64_t size,
                std::vector<std::uint8_t>& out);

}  // namespace saccade
