#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace saccade {

/// The reference decoder of the 16-bit codecs (README 4.2): one symbol at a time, with every access checked.
/// Absent for a faulty payload.
inline std::optional<std::vector<std::uint16_t>> reference_16z(std::span<const std::uint8_t> payload,
                                                               bool with_table, std::size_t room) {
  std::size_t at = 0;
  const auto byte = [&]() -> std::optional<unsigned> {
    return at < payload.size() ? std::optional<unsigned>(payload[at++]) : std::nullopt;
  };
  const auto word = [&]() -> std::optional<std::uint16_t> {
    const auto low = byte(), high = byte();
    if (!low || !high) return std::nullopt;
    return static_cast<std::uint16_t>(*low + 256 * *high);
  };
  std::vector<std::uint16_t> table, pixels;
  if (with_table) {
    const auto count = word();
    if (!count || *count == 0) return std::nullopt;
    for (int i = 0; i < *count; ++i) {
      const auto value = word();
      if (!value) return std::nullopt;
      table.push_back(*value);
    }
  }
  int symbol = 0;
  const auto emit = [&] {
    if (pixels.size() == room || (with_table && symbol >= static_cast<int>(table.size()))) return false;
    pixels.push_back(with_table ? table[static_cast<std::size_t>(symbol)]
                                : static_cast<std::uint16_t>(symbol));
    return true;
  };
  const auto move = [&](int difference) {
    symbol = (symbol - difference) & 0xFFFF;
    return emit();
  };
  const auto escape = [&] {
    const auto d = byte();
    if (!d) return false;
    if (*d >= 0x80) return move(static_cast<int>(*d) - 192);
    const auto e = byte();
    if (!e) return false;
    symbol = static_cast<int>(*d * 256 + *e);
    return emit();
  };
  const auto first = word();
  if (!first) return std::nullopt;
  symbol = *first;
  if (!emit()) return std::nullopt;
  while (at < payload.size()) {
    const unsigned c = payload[at++];
    if (c == 0xFF) {
      if (!escape()) return std::nullopt;
    } else if (c >= 0xE0) {
      for (unsigned i = 0; i < 2 * (c - 0xE0); ++i)
        if (!emit()) return std::nullopt;
    } else {
      if (!move(static_cast<int>(c / 16) - 6)) return std::nullopt;
      const unsigned low = c % 16;
      if (low == 15 && !escape()) return std::nullopt;
      if (low != 13 && low != 15 && !move(static_cast<int>(low) - 6)) return std::nullopt;
    }
  }
  return pixels;
}

}  // namespace saccade
