#include "oni/codec_16z.hpp"

#include <random>

#include <gtest/gtest.h>

#include "oni/bytes.hpp"
#include "reference_16z.hpp"

namespace saccade {
namespace {

using Pixels = std::vector<std::uint16_t>;
using Bytes = std::vector<std::uint8_t>;
using Random = std::independent_bits_engine<std::mt19937, 32, unsigned>;

Bytes encode(Codec16z codec, const Pixels& pixels) {
  Bytes payload;
  Encoder16z encoder;
  EXPECT_TRUE(encoder.encode(codec, pixels, payload));
  return payload;
}

// The fast decoder and the reference agree on whether the payload is good, and on all pixels.
void expect_as_reference(Codec16z codec, const Bytes& payload, std::size_t room) {
  Pixels pixels(room);
  Decoder16z decoder;
  const Decoded16z decoded = decoder.decode(codec, payload, pixels);
  const auto reference = reference_16z(payload, codec == Codec16z::table, room);
  ASSERT_EQ(decoded.fault == nullptr, reference.has_value()) << (decoded.fault ? decoded.fault : "good");
  if (!reference) return;
  pixels.resize(decoded.pixels);
  ASSERT_EQ(pixels, *reference);
}

void expect_round_trip(Codec16z codec, const Pixels& pixels) {
  const Bytes payload = encode(codec, pixels);
  EXPECT_LE(payload.size(), max_size_16z(pixels.size()));
  EXPECT_TRUE(may_hold_16z(payload.size(), pixels.size()));
  const auto reference = reference_16z(payload, codec == Codec16z::table, pixels.size());
  ASSERT_TRUE(reference.has_value());
  ASSERT_EQ(*reference, pixels);
  expect_as_reference(codec, payload, pixels.size());
}

TEST(Codec16z, EncodesTheRunBeforeTheLastNibble) {
  // Symbols 0; 0 0 (a run); 1 0; 0 0 (a run); 2 alone, with low nibble 13.
  const Bytes expected = {3, 0, 0, 0, 0x2a, 3, 0x2b, 3, 0, 0, 0xe1, 0x57, 0xe1, 0x4d};
  EXPECT_EQ(encode(Codec16z::table, {0, 0, 0, 810, 0, 0, 0, 811}), expected);
}

TEST(Codec16z, DecodesTheStockEncodersWrongEndAsItIs) {
  // The stock encoder writes the last nibble before the run and so alters the pixels; see README 11.
  const Bytes stock = {3, 0, 0, 0, 0x2a, 3, 0x2b, 3, 0, 0, 0xe1, 0x57, 0x4d, 0xe1};
  Pixels pixels(8);
  Decoder16z decoder;
  const Decoded16z decoded = decoder.decode(Codec16z::table, stock, pixels);
  EXPECT_EQ(decoded.fault, nullptr);
  EXPECT_EQ(pixels, (Pixels{0, 0, 0, 810, 0, 811, 811, 811}));
}

TEST(Codec16z, RoundTripsRandomSequencesOfAllKinds) {
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t count = 1 + random() % 300;
    const unsigned values = 1 + random() % 400, step = 1 + random() % 150, stay = random() % 100;
    Pixels pixels(count);
    unsigned value = random() % 10000;
    for (auto& pixel : pixels) {
      if (random() % 100 >= stay) value = (value + random() % step) % (values * 20);
      pixel = static_cast<std::uint16_t>(value);
    }
    expect_round_trip(Codec16z::plain, pixels);
    expect_round_trip(Codec16z::table, pixels);
  }
}

TEST(Codec16z, RoundTripsEveryLengthOfRunAtEveryPlace) {
  for (std::size_t before = 0; before < 4; ++before)
    for (std::size_t run = 1; run < 70; ++run)
      for (const int end : {0, 1, 6, 7, 63, 64, 500}) {
        Pixels pixels(before, 1000);
        pixels.insert(pixels.end(), run, 1003);
        pixels.push_back(static_cast<std::uint16_t>(1003 + end));
        expect_round_trip(Codec16z::plain, pixels);
        expect_round_trip(Codec16z::table, pixels);
      }
}

TEST(Codec16z, TableHoldsAnyValueUpTo65535) {
  Random random(2);
  Pixels pixels(20000);
  for (auto& pixel : pixels) pixel = static_cast<std::uint16_t>(random());
  pixels.front() = 65535;
  pixels.back() = 0;
  expect_round_trip(Codec16z::table, pixels);
}

TEST(Codec16z, RefusesFramesThatTheFormatCannotHold) {
  Encoder16z encoder;
  Bytes payload = {7};
  EXPECT_FALSE(encoder.encode(Codec16z::plain, Pixels{0, 40000}, payload));
  EXPECT_EQ(payload, Bytes{7}) << "the payload must not change";
  EXPECT_TRUE(encoder.encode(Codec16z::plain, Pixels{40000, 40001, 39999}, payload))
      << "small steps between large depths are possible";
  Pixels all(65536);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint16_t>(i * 40503);
  EXPECT_FALSE(encoder.encode(Codec16z::table, all, payload));
  EXPECT_THROW(static_cast<void>(encoder.encode(Codec16z::table, {}, payload)), std::invalid_argument);
}

TEST(Codec16z, AgreesWithTheReferenceOnGarbage) {
  Random random(3);
  for (int round = 0; round < 20000; ++round) {
    Bytes payload(random() % 80);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
    const bool table = random() % 2 == 0;
    if (table && payload.size() >= 2) {  // a table that fits, so that decoding reaches the symbols
      payload[0] = static_cast<std::uint8_t>(random() % 20);
      payload[1] = 0;
    }
    expect_as_reference(table ? Codec16z::table : Codec16z::plain, payload, random() % 600);
  }
}

TEST(Codec16z, AgreesWithTheReferenceOnLongGarbage) {
  Random random(5);
  for (int round = 0; round < 400; ++round) {
    Bytes payload(200 + random() % 3000);
    const unsigned escapes = random() % 3;  // none, few or many
    for (auto& byte : payload) {
      byte = static_cast<std::uint8_t>(random());
      if (escapes == 0 || (escapes == 1 && random() % 20 != 0)) byte = byte % 0xE0 & 0xF7;
    }
    if (round % 2 == 1) {
      payload[0] = 100;  // values in the table
      payload[1] = 0;
    }
    expect_as_reference(round % 2 == 1 ? Codec16z::table : Codec16z::plain, payload, random() % 9000);
  }
}

TEST(Codec16z, AgreesWithTheReferenceWhereSymbolsWrap) {
  Random random(6);
  Bytes table = {0xFF, 0xFF};  // every symbol but the last has a value
  for (unsigned i = 0; i < 65535; ++i) {
    table.push_back(static_cast<std::uint8_t>(random()));
    table.push_back(static_cast<std::uint8_t>(random()));
  }
  for (const unsigned start : {0u, 1u, 500u, 1023u, 1024u, 64000u, 65000u, 65534u})
    for (const std::uint8_t step : {std::uint8_t{0x00}, std::uint8_t{0xDE}}) {  // the longest, up and down
      for (std::size_t length = 1; length < 20000; length = 2 * length + 1) {
        Bytes symbols = {static_cast<std::uint8_t>(start), static_cast<std::uint8_t>(start >> 8)};
        symbols.insert(symbols.end(), length, step);
        expect_as_reference(Codec16z::plain, symbols, 40001);
        symbols.insert(symbols.begin(), table.begin(), table.end());
        expect_as_reference(Codec16z::table, symbols, 40001);
      }
    }
}

TEST(Codec16z, ASmallerTableReplacesAllValuesOfTheOneBefore) {
  Decoder16z decoder;
  Pixels pixels(4);
  const auto decode = [&](const Pixels& values, std::uint8_t symbol) {
    ByteBuilder payload;
    payload.put(static_cast<std::uint16_t>(values.size()));
    for (const std::uint16_t value : values) payload.put(value);
    payload.put(std::uint16_t{symbol});
    return decoder.decode(Codec16z::table, payload.bytes(), pixels);
  };
  EXPECT_EQ(decode({10, 20, 30}, 2).fault, nullptr);
  EXPECT_NE(decode({10, 20}, 2).fault, nullptr);
  EXPECT_EQ(decode({10, 20, 30, 40}, 3).fault, nullptr);
  EXPECT_EQ(pixels[0], 40);
}

TEST(Codec16z, AgreesWithTheReferenceOnDamagedFrames) {
  Random random(4);
  Pixels pixels(640);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint16_t>(i % 97 < 40 ? 0 : 900 + i * 3);
  for (const Codec16z codec : {Codec16z::plain, Codec16z::table}) {
    const Bytes whole = encode(codec, pixels);
    for (std::size_t cut = 0; cut < whole.size(); ++cut)
      expect_as_reference(codec, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)),
                          pixels.size());
    for (int round = 0; round < 5000; ++round) {
      Bytes damaged = whole;
      damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
      expect_as_reference(codec, damaged, pixels.size());
    }
  }
}

}  // namespace
}  // namespace saccade
