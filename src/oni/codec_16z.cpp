#include "oni/codec_16z.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "oni/bytes.hpp"

namespace saccade {
namespace {

constexpr std::size_t kSymbols = 65536;
constexpr const char* kCut = "the coded data is cut";
constexpr const char* kTooMany = "more pixels than the image has";
constexpr const char* kNoTable = "the table of values is damaged";
constexpr const char* kNotInTable = "a pixel that is not in the table of values";

// What a byte below 0xE0 without an escape does: two differences, of which the second may be absent.
struct Step {
  std::uint16_t first = 0, second = 0;
  std::uint8_t pixels = 0;  // 0 = not such a byte
};

constexpr std::array<Step, 256> make_steps() {
  std::array<Step, 256> steps{};
  for (unsigned c = 0; c < 0xE0; ++c) {
    const unsigned high = c >> 4, low = c & 15;
    if (low == 15) continue;
    steps[c].first = static_cast<std::uint16_t>(high - 6);
    steps[c].second = low == 13 ? std::uint16_t{0} : static_cast<std::uint16_t>(low - 6);
    steps[c].pixels = low == 13 ? 1 : 2;
  }
  return steps;
}
constexpr std::array<Step, 256> kSteps = make_steps();

// Decodes the symbol stream; a symbol's pixel is table[symbol], or the symbol itself.
template <bool kTable>
class SymbolReader {
 public:
  SymbolReader(std::span<const std::uint8_t> bytes, const std::uint16_t* table, std::uint32_t symbols,
               std::span<std::uint16_t> pixels)
      : in_(bytes.data()),
        in_end_(bytes.data() + bytes.size()),
        table_(table),
        symbols_(symbols),
        begin_(pixels.data()),
        out_(pixels.data()),
        out_end_(pixels.data() + pixels.size()) {}

  Decoded16z run() {
    if (in_end_ - in_ < 2) return result(kCut);
    current_ = load_le<std::uint16_t>(in_);
    in_ += 2;
    if (!emit()) return result(kTooMany);
    run_fast();
    while (in_ < in_end_) {
      const unsigned c = *in_++;
      const char* fault = c < 0xE0 ? pair(c) : c == 0xFF ? escape() : repeat(2 * (c - 0xE0));
      if (fault != nullptr) return result(fault);
    }
    return result(nullptr);
  }

 private:
  static constexpr std::ptrdiff_t kMaxRun = 60;  // pixels of one byte

  Decoded16z result(const char* fault) const {
    if (fault == nullptr && outside_) fault = kNotInTable;
    return {static_cast<std::size_t>(out_ - begin_), fault};
  }

  std::uint16_t pixel() {
    if constexpr (kTable) {
      // The table has room for every symbol, so an unknown one is read harmlessly and told at the end.
      outside_ |= current_ >= symbols_;
      return table_[current_];
    } else {
      return static_cast<std::uint16_t>(current_);
    }
  }

  bool emit() {
    if (out_ == out_end_) return false;
    *out_++ = pixel();
    return true;
  }

  // All bytes but escapes, as long as there is room for whatever one byte can give.
  void run_fast() {
    const std::uint8_t* in = in_;
    std::uint16_t* out = out_;
    while (in < in_end_ && out_end_ - out >= kMaxRun) {
      const unsigned c = *in;
      if (const Step step = kSteps[c]; step.pixels != 0) {
        current_ = (current_ - step.first) & 0xFFFF;
        out[0] = pixel();
        current_ = (current_ - step.second) & 0xFFFF;
        out[1] = pixel();
        out += step.pixels;
        ++in;
      } else if (c >= 0xE0 && c < 0xFF) {
        const std::uint16_t value = pixel();
        const std::size_t count = 2 * (c - 0xE0);
        std::fill_n(out, 30, value);
        if (count > 30) std::fill_n(out + 30, kMaxRun - 30, value);
        out += count;
        ++in;
      } else {
        in_ = in + 1;
        out_ = out;
        if (c != 0xFF) {
          current_ = (current_ - ((c >> 4) - 6)) & 0xFFFF;
          *out_++ = pixel();
        }
        if (escape() != nullptr) {
          // The careful loop meets the same fault again and names it.
          in_ = in;
          out_ = out;
          if (c != 0xFF) current_ = (current_ + ((c >> 4) - 6)) & 0xFFFF;
          return;
        }
        in = in_;
        out = out_;
      }
    }
    in_ = in;
    out_ = out;
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
  const std::uint16_t* const table_;
  const std::uint32_t symbols_;
  std::uint16_t* const begin_;
  std::uint16_t* out_;
  std::uint16_t* const out_end_;
  std::uint32_t current_ = 0;  // 16 bits; wider, so that writing pixels cannot be taken for changing it
  bool outside_ = false;
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
  if (codec == Codec16z::plain) return SymbolReader<false>(payload, nullptr, kSymbols, pixels).run();
  if (payload.size() < 2) return {0, kCut};
  const std::size_t count = load_le<std::uint16_t>(payload.data());
  if (count == 0 || payload.size() < 2 + 2 * count + 2) return {0, kNoTable};
  table_.resize(kSymbols);
  std::memcpy(table_.data(), payload.data() + 2, 2 * count);
  return SymbolReader<true>(payload.subspan(2 + 2 * count), table_.data(), static_cast<std::uint32_t>(count),
                            pixels)
      .run();
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
