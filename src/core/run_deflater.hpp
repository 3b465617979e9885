#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace saccade {

/// Compresses as zlib (RFC 1950, 1951) does, with little searching: a byte that repeats 15 times becomes a
/// run, and some shorter ones, everything else single bytes in a Huffman code of each block. The filtered
/// rows of pictures come out as small as by zlib's fast levels, since noise repeats nothing, and flat parts
/// are runs of zeros. Every reader of zlib's format reads it. The same blocks give the same bytes.
class RunDeflater {
 public:
  RunDeflater();

  /// Appends 1 to 2^24 bytes as a block with a code of its own, which takes some 80 bytes; blocks
  /// of 2^15 to 2^17 bytes suit pictures.
  void add(std::span<const std::uint8_t> block);

  /// All that was added, compressed. To be called once, last.
  [[nodiscard]] std::vector<std::uint8_t> finish();

 private:
  /// data[begin..end) repeats data[begin - 1].
  struct Run {
    std::size_t begin, end;
  };

  void find_runs(std::span<const std::uint8_t> block);

  std::vector<std::uint8_t> out_;
  std::vector<Run> runs_;  ///< of the block, in order
  std::uint32_t checksum_;
  std::uint64_t waiting_ = 0;  ///< bits that do not fill a byte yet, the first is the lowest
  int waiting_bits_ = 0;
};

}  // namespace saccade
