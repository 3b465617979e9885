#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace saccade {

/// The words of a line of a cloud's header, or of its values as text: between blanks, tabs and carriage
/// returns.
std::vector<std::string_view> words_of(std::string_view line);

/// The little-endian float of `size` (4 or 8) bytes at `bytes`.
double float_at(const std::uint8_t* bytes, std::size_t size);

}  // namespace saccade
