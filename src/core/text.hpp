#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace saccade {

/// `text` for a terminal: control characters, and bytes that are not UTF-8, become "\xNN". Names of files and
/// devices may hold both; printed as they are, they could colour the terminal or break one line into two.
std::string printable(std::string_view text);

/// The same, but line breaks stay: for text of several lines.
std::string printable_lines(std::string_view text);

/// "1 frame", "3 frames": the number with its noun, which takes an s unless the number is 1.
template <std::integral Number>
std::string counted(Number number, std::string_view noun) {
  return std::to_string(number).append(" ").append(noun).append(number == 1 ? "" : "s");
}

}  // namespace saccade
