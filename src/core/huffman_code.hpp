#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace saccade {

/// A prefix code as deflate (RFC 1951) writes it.
struct HuffmanCode {
  std::vector<std::uint8_t> lengths;  ///< bits of each symbol's code, 0 = the symbol has none
  std::vector<std::uint16_t> codes;   ///< the first bit is the lowest
};

/// The code for symbols that occur this often, none longer than `limit` <= 15 bits; the shortest possible
/// unless the limit matters. Symbols that do not occur get none. The same counts give the same code. At least
/// two symbols must occur, at most 2^limit, and the sum of the counts must be below 2^32.
[[nodiscard]] HuffmanCode make_huffman_code(std::span<const std::uint32_t> counts, int limit);

}  // namespace saccade
