#include "core/run_deflater.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <libdeflate.h>

#include "core/huffman_code.hpp"

namespace saccade {
namespace {

static_assert(std::endian::native == std::endian::little, "bits are stored eight bytes at a time");

// Symbols: 0..255 bytes, then the end of a block, then lengths of repetitions.
constexpr std::size_t kEndOfBlock = 256, kFirstLength = 257, kSymbols = 286, kDistances = 2;
constexpr int kLongestCode = 14;  // four codes and 7 waiting bits fit into 64 bits
constexpr std::size_t kShortestMatch = 3, kLongestMatch = 258;
constexpr std::size_t kWord = sizeof(std::uint64_t);

/// How a length of 3..258 is written: its symbol, and bits that follow.
struct LengthCode {
  std::uint16_t symbol;
  std::uint8_t extra, extra_bits;
};

constexpr std::array<LengthCode, kLongestMatch + 1> make_length_codes() {
  std::array<LengthCode, kLongestMatch + 1> codes{};
  std::size_t length = kShortestMatch;
  for (int symbol = kFirstLength; symbol < 285; ++symbol) {
    const int bits = symbol < 265 ? 0 : (symbol - 261) / 4;
    for (int extra = 0; extra < 1 << bits; ++extra)
      codes[length++] = {static_cast<std::uint16_t>(symbol), static_cast<std::uint8_t>(extra),
                         static_cast<std::uint8_t>(bits)};
  }
  codes[kLongestMatch] = {285, 0, 0};
  return codes;
}

constexpr std::array<LengthCode, kLongestMatch + 1> kLengthCodes = make_length_codes();

std::uint64_t load(const std::uint8_t* from) {
  std::uint64_t word;
  std::memcpy(&word, from, sizeof word);
  return word;
}

// Divides a run into repetitions that deflate has: job(length).
template <typename Job>
void for_matches(std::size_t run, Job job) {
  while (run > 0) {
    std::size_t length = std::min(run, kLongestMatch);
    if (const std::size_t rest = run - length; rest > 0 && rest < kShortestMatch) length -= kShortestMatch;
    job(length);
    run -= length;
  }
}

/// Writes bits into memory that has room for them.
class BitWriter {
 public:
  BitWriter(std::uint8_t* to, std::uint64_t waiting, int waiting_bits)
      : to_(to), waiting_(waiting), bits_(waiting_bits) {}

  void put(std::uint64_t value, int bits) {
    waiting_ |= value << bits_;
    bits_ += bits;
  }

  /// Stores the whole bytes; fewer than 8 bits remain. Writes up to 8 bytes beyond them.
  void flush() {
    std::memcpy(to_, &waiting_, sizeof waiting_);
    to_ += bits_ >> 3;
    waiting_ >>= bits_ & ~7;
    bits_ &= 7;
  }

  std::uint8_t* end() const { return to_; }
  std::uint64_t waiting() const { return waiting_; }
  int waiting_bits() const { return bits_; }

 private:
  std::uint8_t* to_;
  std::uint64_t waiting_;
  int bits_;
};

// The number of each symbol in the block. Four tables, since equal neighbours would wait for each other.
template <typename Runs>
std::array<std::uint32_t, kSymbols> count_symbols(std::span<const std::uint8_t> block, const Runs& runs) {
  std::array<std::array<std::uint32_t, 256>, 4> of_bytes{};
  std::array<std::uint32_t, kSymbols> counts{};
  std::size_t i = 0;
  const auto count_until = [&](std::size_t end) {
    for (; i + 4 <= end; i += 4)
      for (std::size_t k = 0; k < 4; ++k) ++of_bytes[k][block[i + k]];
    for (; i < end; ++i) ++of_bytes[0][block[i]];
  };
  for (const auto& run : runs) {
    count_until(run.begin);
    for_matches(run.end - run.begin, [&](std::size_t length) { ++counts[kLengthCodes[length].symbol]; });
    i = run.end;
  }
  count_until(block.size());
  for (std::size_t k = 0; k < 256; ++k)
    counts[k] = of_bytes[0][k] + of_bytes[1][k] + of_bytes[2][k] + of_bytes[3][k];
  counts[kEndOfBlock] = 1;
  return counts;
}

/// One symbol of the list of code lengths: itself, and bits that follow.
struct ListSymbol {
  std::uint8_t symbol, extra, extra_bits;
};

// The lengths with repetitions shortened (RFC 1951, 3.2.7).
std::vector<ListSymbol> shorten(std::span<const std::uint8_t> lengths) {
  std::vector<ListSymbol> list;
  const auto repeat = [&](int symbol, std::size_t extra, int bits) {
    list.push_back({static_cast<std::uint8_t>(symbol), static_cast<std::uint8_t>(extra),
                    static_cast<std::uint8_t>(bits)});
  };
  for (std::size_t i = 0; i < lengths.size();) {
    const std::uint8_t length = lengths[i];
    std::size_t equal = 1;
    while (i + equal < lengths.size() && lengths[i + equal] == length) ++equal;
    i += equal;
    if (length > 0) {
      list.push_back({length, 0, 0});
      --equal;
    }
    for (std::size_t taken = 0; equal > 0; equal -= taken) {
      if (length == 0 && equal > 10)
        repeat(18, (taken = std::min<std::size_t>(equal, 138)) - 11, 7);
      else if (length == 0 && equal > 2)
        repeat(17, (taken = equal) - 3, 3);
      else if (equal > 2)
        repeat(16, (taken = std::min<std::size_t>(equal, 6)) - 3, 2);
      else
        list.push_back({length, static_cast<std::uint8_t>((taken = 1) - 1), 0});
    }
  }
  return list;
}

// The head of a block: the lengths of its codes, themselves in a Huffman code.
void put_head(BitWriter& bits, const HuffmanCode& code) {
  constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                   11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::vector<std::uint8_t> lengths = code.lengths;
  while (lengths.back() == 0) lengths.pop_back();
  const std::size_t symbols = lengths.size();
  lengths.insert(lengths.end(), kDistances, 1);
  const std::vector<ListSymbol> list = shorten(lengths);
  std::array<std::uint32_t, kOrder.size()> counts{};
  for (const ListSymbol& item : list) ++counts[item.symbol];
  const HuffmanCode list_code = make_huffman_code(counts, 7);
  std::size_t listed = kOrder.size();
  while (listed > 4 && list_code.lengths[kOrder[listed - 1]] == 0) --listed;

  bits.put(2 << 1, 3);  // not the last block; codes of its own
  bits.put(symbols - 257, 5);
  bits.put(kDistances - 1, 5);
  bits.put(listed - 4, 4);
  bits.flush();
  for (std::size_t i = 0; i < listed; ++i) {
    bits.put(list_code.lengths[kOrder[i]], 3);
    bits.flush();
  }
  for (const auto [symbol, extra, extra_bits] : list) {
    bits.put(list_code.codes[symbol], list_code.lengths[symbol]);
    bits.put(extra, extra_bits);
    bits.flush();
  }
}

/// A symbol's code, and above its 16 bits their number.
using PackedCodes = std::array<std::uint32_t, kSymbols>;

void put_symbol(BitWriter& bits, std::uint32_t packed) {
  bits.put(packed & 0xFFFF, static_cast<int>(packed >> 16));
}

template <typename Runs>
void put_block(BitWriter& bits, std::span<const std::uint8_t> block, const Runs& runs,
               const PackedCodes& codes) {
  std::size_t i = 0;
  const auto put_until = [&](std::size_t end) {
    for (; i + 4 <= end; i += 4) {
      for (std::size_t k = 0; k < 4; ++k) put_symbol(bits, codes[block[i + k]]);
      bits.flush();
    }
    for (; i < end; ++i) put_symbol(bits, codes[block[i]]);  // at most three
    bits.flush();
  };
  for (const auto& run : runs) {
    put_until(run.begin);
    for_matches(run.end - run.begin, [&](std::size_t length) {
      const LengthCode& written = kLengthCodes[length];
      put_symbol(bits, codes[written.symbol]);
      bits.put(written.extra, written.extra_bits);
      bits.put(0, 1);  // the first of two distances: 1 byte back
      bits.flush();
    });
    i = run.end;
  }
  put_until(block.size());
  put_symbol(bits, codes[kEndOfBlock]);
  bits.flush();
}

}  // namespace

RunDeflater::RunDeflater() : out_{0x78, 0x01}, checksum_(libdeflate_adler32(0, nullptr, 0)) {}

// Compares words with the bytes before them: every run of 15 bytes has a word that equals its predecessors,
// and so have some of the runs from 8 on.
void RunDeflater::find_runs(std::span<const std::uint8_t> block) {
  runs_.clear();
  const std::uint8_t* data = block.data();
  std::size_t least = 1;  // a run needs a byte that it repeats
  for (std::size_t i = kWord; i + kWord <= block.size();) {
    if (load(data + i) != load(data + i - 1)) {
      i += kWord;
      continue;
    }
    std::size_t begin = i, end = i + kWord;
    while (begin > least && data[begin - 1] == data[begin - 2]) --begin;
    while (end < block.size() && data[end] == data[end - 1]) ++end;
    runs_.push_back({begin, end});
    least = end + 1;
    i = (end + kWord) / kWord * kWord;
  }
}

void RunDeflater::add(std::span<const std::uint8_t> block) {
  constexpr std::size_t kMostOfHead = 1024, kMostAfterLength = 6;  // bytes; bits
  checksum_ = libdeflate_adler32(checksum_, block.data(), block.size());
  find_runs(block);
  const std::array<std::uint32_t, kSymbols> counts = count_symbols(block, runs_);
  const HuffmanCode code = make_huffman_code(counts, kLongestCode);
  PackedCodes codes{};
  std::size_t most_bits = 8 * kMostOfHead;
  for (std::size_t i = 0; i < kSymbols; ++i) {
    codes[i] = code.codes[i] | static_cast<std::uint32_t>(code.lengths[i]) << 16;
    most_bits += counts[i] * (code.lengths[i] + (i > kEndOfBlock ? kMostAfterLength : 0));
  }
  const std::size_t begin = out_.size();
  out_.resize(begin + most_bits / 8);
  BitWriter bits(out_.data() + begin, waiting_, waiting_bits_);
  put_head(bits, code);
  put_block(bits, block, runs_, codes);
  out_.resize(static_cast<std::size_t>(bits.end() - out_.data()));
  waiting_ = bits.waiting();
  waiting_bits_ = bits.waiting_bits();
}

std::vector<std::uint8_t> RunDeflater::finish() {
  // The last block is empty and in the code that deflate fixes, where seven zeros end a block.
  std::uint64_t rest = waiting_ | std::uint64_t{1 | 1 << 1} << waiting_bits_;
  for (int bits = waiting_bits_ + 10; bits > 0; bits -= 8, rest >>= 8)
    out_.push_back(static_cast<std::uint8_t>(rest));
  for (const int shift : {24, 16, 8, 0}) out_.push_back(static_cast<std::uint8_t>(checksum_ >> shift));
  return std::move(out_);
}

}  // namespace saccade
