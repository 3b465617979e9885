#include "oni/codec_im8z.hpp"

#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes decode(const Bytes& payload, std::size_t room, bool& good) {
  Bytes bytes(room);
  const DecodedIm8z decoded = decode_im8z(payload, bytes);
  good = decoded.fault == nullptr;
  bytes.resize(decoded.bytes);
  return bytes;
}

TEST(Im8z, DecodesEachKindOfCode) {
  bool good = false;
  EXPECT_EQ(decode({100}, 9, good), (Bytes{100}));
  EXPECT_EQ(decode({100, 0x75}, 9, good), (Bytes{100, 99, 100})) << "differences 1 and -1 are subtracted";
  EXPECT_EQ(decode({100, 0x7D}, 9, good), (Bytes{100, 99})) << "low nibble 13: no second symbol";
  EXPECT_EQ(decode({100, 0x7F, 7}, 9, good), (Bytes{100, 99, 7})) << "low nibble 15: a value follows";
  EXPECT_EQ(decode({100, 0xE2}, 9, good), (Bytes{100, 100, 100, 100, 100}));
  EXPECT_EQ(decode({100, 0xF1, 0x2D}, 9, good), (Bytes{100, 0x12}));
  EXPECT_EQ(decode({100, 0xF1, 0x27}, 9, good), (Bytes{100, 0x12, 0x11}));
  EXPECT_EQ(decode({100, 0xF1, 0x2F, 3}, 9, good), (Bytes{100, 0x12, 3}));
  EXPECT_TRUE(good);
  EXPECT_EQ(decode({250, 0x06}, 9, good), (Bytes{250, 0, 0})) << "differences wrap at 256";
}

TEST(Im8z, FaultsAreReported) {
  bool good = true;
  for (const Bytes& payload : {Bytes{}, Bytes{1, 0x7F}, Bytes{1, 0xF1}, Bytes{1, 0xF1, 0x2F}}) {
    decode(payload, 99, good);
    EXPECT_FALSE(good);
  }
  for (const std::size_t room : {0u, 1u, 2u, 30u}) {
    decode({100, 0x75, 0xEF}, room, good);
    EXPECT_FALSE(good) << "more than the room of " << room;
  }
  decode({100, 0x75, 0xEF}, 33, good);
  EXPECT_TRUE(good);
}

TEST(Im8z, GarbageIsDecodedWithinItsRoom) {
  std::mt19937 random(5);
  for (int round = 0; round < 20000; ++round) {
    Bytes payload(random() % 60);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
    const std::size_t room = random() % 200;
    Bytes bytes(room + 16, 0xAB);
    const DecodedIm8z decoded = decode_im8z(payload, std::span(bytes).first(room));
    ASSERT_LE(decoded.bytes, room);
    for (std::size_t i = decoded.bytes; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], 0xAB);
  }
}

}  // namespace
}  // namespace saccade
