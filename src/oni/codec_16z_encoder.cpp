// Encoding of 16zP and 16zT (README 4.2).
#include <cstring>
#include <stdexcept>

#include "oni/bytes.hpp"
#include "oni/codec_16z.hpp"

namespace saccade {
namespace {

// Writes symbols; packs small differences into nibbles and runs. `out` must have room, see max_size_16z().
class SymbolWriter {
 public:
  SymbolWriter(std::uint16_t first, std::uint8_t* out) : out_(out), current_(first) {
    store_le(out_, first);
    out_ += 2;
  }

  // False if the format cannot hold the symbol here.
  bool put(std::uint16_t symbol) {
    const int d = static_cast<std::int16_t>(static_cast<std::uint16_t>(current_ - symbol));
    current_ = symbol;
    if (d >= -6 && d <= 6) {
      put_nibble(static_cast<unsigned>(d + 6));
      return true;
    }
    flush_run();
    *out_++ = pending_ == kNone ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(pending_ << 4 | 15);
    pending_ = kNone;
    if (d >= -63 && d <= 63) {
      *out_++ = static_cast<std::uint8_t>(d + 192);
      return true;
    }
    if (symbol >= 0x8000) return false;  // its high byte would read as a difference
    *out_++ = static_cast<std::uint8_t>(symbol >> 8);
    *out_++ = static_cast<std::uint8_t>(symbol & 255);
    return true;
  }

  // Writes the rest and returns the end. The run is older than the pending nibble, so it comes first.
  std::uint8_t* finish() {
    flush_run();
    if (pending_ != kNone) *out_++ = static_cast<std::uint8_t>(pending_ << 4 | 13);
    return out_;
  }

 private:
  static constexpr unsigned kNone = 16;

  void put_nibble(unsigned nibble) {
    if (pending_ == kNone) {
      pending_ = nibble;
      return;
    }
    const unsigned c = pending_ << 4 | nibble;
    pending_ = kNone;
    if (c == 0x66) {
      if (++run_ == 15) flush_run();
      return;
    }
    flush_run();
    *out_++ = static_cast<std::uint8_t>(c);
  }

  void flush_run() {
    if (run_ > 0) *out_++ = static_cast<std::uint8_t>(0xE0 + run_);
    run_ = 0;
  }

  std::uint8_t* out_;
  std::uint16_t current_;
  unsigned pending_ = kNone;  // the first of two small differences
  unsigned run_ = 0;          // pairs of pixels equal to the one before
};

}  // namespace

void Encoder16z::build_table(std::span<const std::uint16_t> pixels) {
  index_of_.assign(kSymbols16z, 0);
  for (const std::uint16_t pixel : pixels) index_of_[pixel] = 1;
  values_.clear();
  for (std::size_t value = 0; value < kSymbols16z; ++value) {
    if (index_of_[value] == 0) continue;
    index_of_[value] = static_cast<std::uint16_t>(values_.size());
    values_.push_back(static_cast<std::uint16_t>(value));
  }
}

bool Encoder16z::encode(Codec16z codec, std::span<const std::uint16_t> pixels,
                        std::vector<std::uint8_t>& payload) {
  if (pixels.empty()) throw std::invalid_argument("Encoder16z: no pixels");
  const std::size_t start = payload.size();
  const bool table = codec == Codec16z::table;
  if (table) build_table(pixels);
  if (table && values_.size() >= kSymbols16z) return false;  // the u16 count cannot hold it
  payload.resize(start + max_size_16z(pixels.size()));
  std::uint8_t* out = payload.data() + start;
  if (table) {
    store_le(out, static_cast<std::uint16_t>(values_.size()));
    std::memcpy(out + 2, values_.data(), 2 * values_.size());
    out += 2 + 2 * values_.size();
  }
  const auto symbol = [&](std::uint16_t pixel) { return table ? index_of_[pixel] : pixel; };
  SymbolWriter writer(symbol(pixels[0]), out);
  for (const std::uint16_t pixel : pixels.subspan(1))
    if (!writer.put(symbol(pixel))) {
      payload.resize(start);
      return false;
    }
  payload.resize(static_cast<std::size_t>(writer.finish() - payload.data()));
  return true;
}

}  // namespace saccade
