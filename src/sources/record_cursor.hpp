#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "oni/bytes.hpp"

namespace saccade {

/// Takes little-endian numbers and bytes, in order, from a part of a file that may be shorter than it says:
/// then each function throws std::runtime_error. The bytes have to outlive it.
class RecordCursor {
 public:
  explicit RecordCursor(std::span<const std::uint8_t> bytes) : cursor_(bytes) {}

  std::span<const std::uint8_t> rest() const { return cursor_.rest(); }

  template <typename T>
  T take() {
    const auto value = cursor_.take<T>();
    if (!value) throw too_short();
    return *value;
  }

  std::span<const std::uint8_t> take_bytes(std::size_t count) {
    const auto bytes = cursor_.take_bytes(count);
    if (!bytes) throw too_short();
    return *bytes;
  }

  void skip(std::size_t count) { take_bytes(count); }

  /// A string after its length, a u32.
  std::string take_text() {
    const auto text = take_bytes(take<std::uint32_t>());
    return {text.begin(), text.end()};
  }

  /// Throws std::runtime_error if other bytes are next.
  void expect(std::string_view signature) {
    if (!std::ranges::equal(take_bytes(signature.size()), signature))
      throw std::runtime_error("the file is damaged: no " + std::string(signature) + " where one has to be");
  }

 private:
  static std::runtime_error too_short() {
    return std::runtime_error("a part of the file is shorter than it says");
  }

  ByteCursor cursor_;
};

}  // namespace saccade
