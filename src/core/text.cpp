#include "core/text.hpp"

#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace saccade {
namespace {

constexpr std::size_t kNotPrintable = 0;

// The number of bytes of the well-formed, printable UTF-8 character at the start of `text`, or kNotPrintable.
std::size_t printable_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : kNotPrintable;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < size) return kNotPrintable;
  std::uint32_t code = first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return kNotPrintable;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool control = code < 0xa0;  // of the second half of Latin-1
  const bool line_break = code == 0x2028 || code == 0x2029;
  const bool direction = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  if (too_long || code > 0x10ffff || surrogate || control || line_break || direction) return kNotPrintable;
  return size;
}

std::string escape(std::string_view text, bool keep_line_breaks) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t size = printable_bytes(text.substr(at));
    if (keep_line_breaks && text[at] == '\n') size = 1;
    if (size == kNotPrintable) {
      out += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(text[at++]));
      continue;
    }
    out += text.substr(at, size);
    at += size;
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return escape(text, false); }

std::string printable_lines(std::string_view text) { return escape(text, true); }

}  // namespace saccade
