#include "oni/codec_16z.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "oni/bytes.hpp"

namespace saccade {
namespace {

constexpr std::size_t kSymbols = 65536;
constexpr std::uint32_t kNoValue = 1u << 31;
constexpr const char* kCut = "the coded data is cut";
constexpr const char* kTooMany = "more pixels than the image has";
constexpr const char* kNoTable = "the table of values is damaged";
constexpr const char* kNotInTable = "a pixel that is not in the table of values";

// What a byte does that is no escape: one pixel `first` below the last, and then `pixels` - 1 of the value
// `last` below the one before the byte. Runs are the same with differences of 0.
struct Step {
  std::uint16_t first = 0, last = 0;
  std::uint8_t pixels = 0;
  bool simple = false;  // not an escape, and at most kSimplePixels
};
constexpr std::size_t kSimplePixels = 16;

constexpr std::array<Step, 256> make_steps() {
  std::array<Step, 256> steps{};
  for (unsigned c = 0; c < 0xFF; ++c) {
    const unsigned high = c >> 4, low = c & 15;
    Step& step = steps[c];
    if (c >= 0xE0) {
      step.pixels = static_cast<std::uint8_t>(2 * (c - 0xE0));
      step.simple = step.pixels <= kSimplePixels;
    } else if (low != 15) {
      step.first = static_cast<std::uint16_t>(high - 6);
      step.last = low == 13 ? step.first : static_cast<std::uint16_t>(high - 6 + low - 6);
      step.pixels = low == 13 ? 1 : 2;
      step.simple = true;
    }
  }
  return steps;
}
constexpr std::array<Step, 256> kSteps = make_steps();

// Decodes the symbol stream; a symbol's pixel is table[symbol], or the symbol itself. A table has kSymbols
// entries, those without a value marked kNoValue, so that any symbol may be looked up and the mark is noticed
// at the end.
template <bool kTable>
class SymbolReader {
 public:
  SymbolReader(std::span<const std::uint8_t> bytes, const std::uint32_t* table,
               std::span<std::uint16_t> pixels)
      : in_(bytes.data()),
        in_end_(bytes.data() + bytes.size()),
        table_(table),
        begin_(pixels.data()),
        out_(pixels.data()),
        out_end_(pixels.data() + pixels.size()) {}

  Decoded16z run() {
    if (in_end_ - in_ < 2) return result(kCut);
    current_ = load_le<std::uint16_t>(in_);
    in_ += 2;
    if (!emit()) return result(kTooMany);
    while (in_ < in_end_) {
      run_simple();
      if (in_ == in_end_) break;
      const unsigned c = *in_++;
      const char* fault = c < 0xE0 ? pair(c) : c == 0xFF ? escape() : repeat(2 * (c - 0xE0));
      if (fault != nullptr) return result(fault);
    }
    return result(nullptr);
  }

 private:
  Decoded16z result(const char* fault) const {
    if (fault == nullptr && (seen_ & kNoValue) != 0) fault = kNotInTable;
    return {static_cast<std::size_t>(out_ - begin_), fault};
  }

  std::uint32_t value(std::uint32_t symbol) const {
    if constexpr (kTable) return table_[symbol];
    return symbol;
  }

  std::uint16_t pixel() {
    const std::uint32_t v = value(current_);
    seen_ |= v;
    return static_cast<std::uint16_t>(v);
  }

  bool emit() {
    if (out_ == out_end_) return false;
    *out_++ = pixel();
    return true;
  }

  // The common bytes, as long as there is room: no branch depends on what they are, since that cannot be
  // predicted. More pixels than the byte stands for are written, and overwritten by the next.
  void run_simple() {
    const std::uint8_t* in = in_;
    std::uint16_t* out = out_;
    std::uint32_t current = current_, seen = 0;
    while (in < in_end_ && static_cast<std::size_t>(out_end_ - out) >= kSimplePixels) {
      const Step step = kSteps[*in];
      if (!step.simple) break;
      const std::uint32_t first = value((current - step.first) & 0xFFFF);
      current = (current - step.last) & 0xFFFF;
      const std::uint32_t last = value(current);
      seen |= first | last;
      std::fill_n(out, kSimplePixels, static_cast<std::uint16_t>(last));
      *out = static_cast<std::uint16_t>(first);
      out += step.pixels;
      ++in;
    }
    in_ = in;
    out_ = out;
    current_ = current;
    seen_ |= seen;
  }

  const char* pair(unsigned c) {
    const unsigned high = c >> 4, low = c & 15;
    current_ = (current_ - (high - 6)) & 0xFFFF;
    if (!emit()) return kTooMany;
    if (low == 13) return nullptr;
    if (low == 15) return escape();
    current_ = (current_ - (low - 6)) & 0xFFFF;
    return emit() ? nullptr : kTooMany;
  }

  const char* repeat(std::size_t count) {
    if (static_cast<std::size_t>(out_end_ - out_) < count) return kTooMany;
    if (count > 0) out_ = std::fill_n(out_, count, pixel());
    return nullptr;
  }

  // A larger difference in one byte, or the symbol itself in two.
  const char* escape() {
    if (in_ == in_end_) return kCut;
    const unsigned d = *in_;
    if (d >= 0x80) {
      current_ = (current_ - (d - 192)) & 0xFFFF;
      in_ += 1;
    } else {
      if (in_end_ - in_ < 2) return kCut;
      current_ = d << 8 | in_[1];
      in_ += 2;
    }
    return emit() ? nullptr : kTooMany;
  }

  const std::uint8_t* in_;
  const std::uint8_t* const in_end_;
  const std::uint32_t* const table_;
  std::uint16_t* const begin_;
  std::uint16_t* out_;
  std::uint16_t* const out_end_;
  std::uint32_t current_ = 0;  // 16 bits; wider, so that writing pixels cannot be taken for changing it
  std::uint32_t seen_ = 0;     // all values together
};

// Writes symbols, packing small differences into nibbles and runs.
class SymbolWriter {
 public:
  SymbolWriter(std::uint16_t first, std::uint8_t* out) : out_(out), current_(first) {
    store_le(out_, first);
    out_ += 2;
  }

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

  // The run is older than the pending nibble and goes first.
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

Decoded16z Decoder16z::decode(Codec16z codec, std::span<const std::uint8_t> payload,
                              std::span<std::uint16_t> pixels) {
  if (codec == Codec16z::plain) return SymbolReader<false>(payload, nullptr, pixels).run();
  if (payload.size() < 2) return {0, kCut};
  const std::size_t count = load_le<std::uint16_t>(payload.data());
  if (count == 0 || payload.size() < 2 + 2 * count + 2) return {0, kNoTable};
  table_.resize(kSymbols, kNoValue);
  for (std::size_t i = 0; i < count; ++i) table_[i] = load_le<std::uint16_t>(payload.data() + 2 + 2 * i);
  for (std::size_t i = count; i < filled_; ++i) table_[i] = kNoValue;  // of the frame before
  filled_ = count;
  return SymbolReader<true>(payload.subspan(2 + 2 * count), table_.data(), pixels).run();
}

void Encoder16z::build_table(std::span<const std::uint16_t> pixels) {
  index_of_.assign(kSymbols, 0);
  for (const std::uint16_t pixel : pixels) index_of_[pixel] = 1;
  values_.clear();
  for (std::size_t value = 0; value < kSymbols; ++value) {
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
  if (table && values_.size() >= kSymbols) return false;  // their number would not fit its field
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
