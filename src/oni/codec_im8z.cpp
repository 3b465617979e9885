#include "oni/codec_im8z.hpp"

#include <algorithm>

#include "oni/codec_faults.hpp"

namespace saccade {
namespace {

class Im8zReader {
 public:
  Im8zReader(std::span<const std::uint8_t> payload, std::span<std::uint8_t> bytes)
      : in_(payload), out_(bytes) {}

  DecodedIm8z run() {
    const char* fault = literal();
    while (fault == nullptr && next_ < in_.size()) fault = code(in_[next_++]);
    return {written_, fault};
  }

 private:
  const char* code(unsigned c) {
    if (c >= 0xE0 && c < 0xF0) return repeat(std::size_t{2} * (c - 0xE0));
    if (c < 0xE0) {
      current_ = static_cast<std::uint8_t>(current_ - ((c >> 4) - 6));
      const char* fault = repeat(1);
      return fault != nullptr ? fault : low_nibble(c & 15);
    }
    // A value split over two bytes; the rest of the second is a low nibble.
    if (next_ == in_.size()) return kTruncated;
    const unsigned d = in_[next_++];
    current_ = static_cast<std::uint8_t>((c & 15) << 4 | d >> 4);
    const char* fault = repeat(1);
    return fault != nullptr ? fault : low_nibble(d & 15);
  }

  const char* low_nibble(unsigned low) {
    if (low == 13) return nullptr;
    if (low == 15) return literal();
    current_ = static_cast<std::uint8_t>(current_ - (low - 6));
    return repeat(1);
  }

  const char* literal() {
    if (next_ == in_.size()) return kTruncated;
    current_ = in_[next_++];
    return repeat(1);
  }

  const char* repeat(std::size_t count) {
    if (out_.size() - written_ < count) return kTooManyPixels;
    std::fill_n(out_.begin() + static_cast<std::ptrdiff_t>(written_), count, current_);
    written_ += count;
    return nullptr;
  }

  std::span<const std::uint8_t> in_;
  std::span<std::uint8_t> out_;
  std::size_t next_ = 0, written_ = 0;
  std::uint8_t current_ = 0;
};

}  // namespace

DecodedIm8z decode_im8z(std::span<const std::uint8_t> payload, std::span<std::uint8_t> bytes) {
  return Im8zReader(payload, bytes).run();
}

}  // namespace saccade
