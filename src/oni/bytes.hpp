#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace saccade {

static_assert(std::endian::native == std::endian::little,
              "the .oni code copies little-endian numbers without conversion");

/// The little-endian number at the start of `bytes`: at least sizeof(T) of them, aligned or not.
template <typename T>
T load_le(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <typename T>
void store_le(std::uint8_t* bytes, T value) {
  std::memcpy(bytes, &value, sizeof value);
}

/// Reads numbers and strings in order from unchecked bytes. A read that the remaining bytes cannot satisfy
/// returns nothing and does not advance.
class ByteCursor {
 public:
  explicit ByteCursor(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  std::span<const std::uint8_t> rest() const { return rest_; }

  template <typename T>
  std::optional<T> take() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    const T value = load_le<T>(rest_.data());
    rest_ = rest_.subspan(sizeof(T));
    return value;
  }

  std::optional<std::span<const std::uint8_t>> take_bytes(std::size_t count) {
    if (rest_.size() < count) return std::nullopt;
    const auto bytes = rest_.first(count);
    rest_ = rest_.subspan(count);
    return bytes;
  }

  /// A string (README 1): u32 length with the final NUL, 1..`limit`; no other NUL.
  std::optional<std::string> take_string(std::uint32_t limit) {
    ByteCursor ahead = *this;
    const auto length = ahead.take<std::uint32_t>();
    if (!length || *length < 1 || *length > limit) return std::nullopt;
    const auto bytes = ahead.take_bytes(*length);
    if (!bytes || bytes->back() != 0) return std::nullopt;
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), *length - 1);
    if (text.find('\0') != std::string_view::npos) return std::nullopt;
    *this = ahead;
    return std::string(text);
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Appends numbers and strings in the layout of the format.
class ByteBuilder {
 public:
  template <typename T>
  void put(T value) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  void put_bytes(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put_string(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }

  std::size_t size() const { return bytes_.size(); }
  std::span<const std::uint8_t> bytes() const { return bytes_; }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }
  /// Keeps the first `size` bytes.
  void cut(std::size_t size) { bytes_.resize(size); }
  void clear() { bytes_.clear(); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace saccade
