#pragma once

#include <string>
#include <string_view>

namespace saccade {

/// `text` for a terminal: control characters, and bytes that are not UTF-8, become "\xNN". Names of files and
/// devices may hold both; printed as they are, they could colour the terminal or break one line into two.
std::string printable(std::string_view text);

/// The same, but line breaks stay: for text of several lines.
std::string printable_lines(std::string_view text);

}  // namespace saccade
