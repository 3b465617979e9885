#include "sources/lzf.hpp"

#include <algorithm>
#include <cstddef>

namespace saccade {

// The stream is a sequence of
//   000LLLLL, L+1 bytes                     these bytes as they are
//   LLLooooo, [L' if LLL = 111], oooooooo   L + 2 (+ L') bytes again, from o + 1 bytes back in the output
bool lzf_decompress(std::span<const std::uint8_t> input, std::span<std::uint8_t> output) {
  std::size_t in = 0, out = 0;
  while (in < input.size()) {
    const unsigned control = input[in++];
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > input.size() - in || length > output.size() - out) return false;
      std::copy_n(input.begin() + static_cast<std::ptrdiff_t>(in), length,
                  output.begin() + static_cast<std::ptrdiff_t>(out));
      in += length;
      out += length;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    if (length == 9) {
      if (in == input.size()) return false;
      length += input[in++];
    }
    if (in == input.size()) return false;
    const std::size_t back = ((control & 31) << 8 | input[in++]) + std::size_t{1};
    if (back > out || length > output.size() - out) return false;
    for (; length > 0; --length, ++out) output[out] = output[out - back];  // may overlap: byte by byte
  }
  return out == output.size();
}

}  // namespace saccade
