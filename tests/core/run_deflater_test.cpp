#include "core/run_deflater.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <libdeflate.h>

#include "core/huffman_code.hpp"

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes deflated(const Bytes& data, std::size_t block_bytes) {
  RunDeflater deflater;
  for (std::size_t i = 0; i < data.size(); i += block_bytes)
    deflater.add(std::span(data).subspan(i, std::min(block_bytes, data.size() - i)));
  return deflater.finish();
}

// Empty if the decoder refuses the data.
Bytes inflated(const Bytes& compressed, std::size_t size) {
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  Bytes data(size);
  std::size_t written = 0;
  const auto result = libdeflate_zlib_decompress(decompressor, compressed.data(), compressed.size(),
                                                 data.data(), data.size(), &written);
  libdeflate_free_decompressor(decompressor);
  data.resize(result == LIBDEFLATE_SUCCESS ? written : 0);
  return data;
}

TEST(RunDeflater, RoundTripOfNoiseAndRuns) {
  std::mt19937 random(5);
  for (const double spread : {0.0, 0.6, 3.0, 40.0}) {
    std::normal_distribution<double> noise(0, spread + 1e-9);
    Bytes data;
    while (data.size() < 100'000) {
      const auto value = static_cast<std::uint8_t>(std::lround(noise(random)));
      const bool runs = random() % 64 == 0;
      data.insert(data.end(), runs ? random() % 1000 : 1, value);
    }
    for (const std::size_t block : {std::size_t{1000}, std::size_t{1} << 16, data.size()})
      EXPECT_EQ(inflated(deflated(data, block), data.size()), data) << spread << " in blocks of " << block;
  }
}

TEST(RunDeflater, RunsOfEveryLengthAtEveryPlace) {
  Bytes data;
  for (std::size_t length = 0; length < 600; ++length) {
    data.push_back(static_cast<std::uint8_t>(length));
    data.insert(data.end(), length, static_cast<std::uint8_t>(length * 7 + 1));
  }
  EXPECT_EQ(inflated(deflated(data, data.size()), data.size()), data);
  for (std::size_t size = 1; size < 40; ++size) {
    const Bytes zeros(size);
    EXPECT_EQ(inflated(deflated(zeros, size), size), zeros) << size;
    EXPECT_EQ(inflated(deflated(zeros, 1), size), zeros) << "blocks of one byte";
  }
}

TEST(RunDeflater, FlatDataIsAFewRuns) { EXPECT_LT(deflated(Bytes(1 << 16), 1 << 16).size(), 120U); }

TEST(RunDeflater, NoiseOfAllBytesHardlyGrows) {
  std::mt19937 random(6);
  Bytes data(1 << 16);
  for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
  const Bytes compressed = deflated(data, data.size());
  EXPECT_LT(compressed.size(), data.size() + 300);
  EXPECT_EQ(inflated(compressed, data.size()), data);
}

TEST(RunDeflater, CodesThatWouldBeTooLongAreCut) {
  Bytes data;  // each byte 1.6 times as often as the one before: Huffman's codes would have 20 bits
  double count = 1;
  for (int value = 0; value < 21; ++value, count *= 1.62)
    for (int i = 0; i < std::lround(count); ++i) {
      data.push_back(static_cast<std::uint8_t>(value));
      data.push_back(200);  // no runs
    }
  EXPECT_EQ(inflated(deflated(data, data.size()), data.size()), data);
}

double average_bits(const std::vector<std::uint32_t>& counts, const HuffmanCode& code) {
  double bits = 0, all = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    bits += static_cast<double>(counts[i]) * code.lengths[i];
    all += counts[i];
  }
  return bits / all;
}

// Of 2^-length over all codes: 1 if every sequence of bits begins with exactly one code.
double kraft_sum(const HuffmanCode& code) {
  double sum = 0;
  for (const std::uint8_t length : code.lengths) sum += length > 0 ? std::ldexp(1.0, -length) : 0;
  return sum;
}

TEST(HuffmanCode, IsCompleteAndWithinABitOfTheEntropy) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint32_t> counts(2 + random() % 285);
    double all = 0, entropy = 0;
    for (std::uint32_t& count : counts)
      count = random() % 5 == 0 ? 0U : static_cast<std::uint32_t>(1 + random() % (1U << random() % 12));
    counts.front() = counts.back() = 1;
    for (const std::uint32_t count : counts) all += count;
    for (const std::uint32_t count : counts) entropy -= count > 0 ? count / all * std::log2(count / all) : 0;
    const HuffmanCode code = make_huffman_code(counts, 15);
    EXPECT_EQ(kraft_sum(code), 1);
    EXPECT_GE(average_bits(counts, code), entropy - 1e-9);
    EXPECT_LT(average_bits(counts, code), entropy + 1);
  }
}

TEST(HuffmanCode, OfKnownCounts) {
  const HuffmanCode code = make_huffman_code(std::vector<std::uint32_t>{8, 0, 1, 2, 4}, 15);
  EXPECT_EQ(code.lengths, (Bytes{1, 0, 3, 3, 2}));
  EXPECT_EQ(code.codes, (std::vector<std::uint16_t>{0b0, 0, 0b011, 0b111, 0b01})) << "first bit lowest";
}

TEST(HuffmanCode, ALimitMakesItLessThanPerfectButComplete) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t a = 1, b = 1; counts.size() < 19; a = std::exchange(b, a + b)) counts.push_back(a);
  const HuffmanCode best = make_huffman_code(counts, 15);
  for (const int limit : {7, 5}) {
    const HuffmanCode code = make_huffman_code(counts, limit);
    EXPECT_EQ(kraft_sum(code), 1);
    EXPECT_LE(*std::max_element(code.lengths.begin(), code.lengths.end()), limit);
    EXPECT_GE(average_bits(counts, code), average_bits(counts, best));
    EXPECT_LT(average_bits(counts, code), 1.1 * average_bits(counts, best) + 0.5);
  }
}

}  // namespace
}  // namespace saccade
