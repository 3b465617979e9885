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

// What a byte does: one pixel `first` symbols above the last, and then `pixels` - 1 of the symbol `last`
// above the one before the byte. A run is the same with differences of 0. An escape has its own code after
// that: its `last` is that of its first pixel, if it has one.
struct Step {
  std::int8_t first = 0, last = 0;
  std::uint8_t pixels = 0;
  bool escape = false;
};

constexpr std::array<Step, 256> make_steps() {
  std::array<Step, 256> steps{};
  for (unsigned c = 0; c < 256; ++c) {
    const int high = static_cast<int>(c >> 4), low = static_cast<int>(c & 15);
    Step& step = steps[c];
    if (c >= 0xE0) {
      step.escape = c == 0xFF;
      step.pixels = static_cast<std::uint8_t>(step.escape ? 0 : 2 * (c - 0xE0));
      continue;
    }
    const bool pair = low != 13 && low != 15;
    step.first = static_cast<std::int8_t>(6 - high);
    step.last = static_cast<std::int8_t>(step.first + (pair ? 6 - low : 0));
    step.pixels = pair ? 2 : 1;
    step.escape = low == 15;
  }
  return steps;
}
constexpr std::array<Step, 256> kSteps = make_steps();

// The fast loop takes so many bytes or escapes without looking at the bounds in between.
constexpr std::size_t kBlock = 64;
constexpr std::size_t kMostBytes = 3;    // of one of them
constexpr std::size_t kMostPixels = 64;  // that one of them may write to
// A symbol wanders at most so far in a block, except by an escape, which sets it anew.
constexpr std::size_t kGuard = 16 * kBlock;

// The place in the sequence of symbols, and the pixel that a symbol stands for. A symbol may leave 0..65535
// by kGuard on either side before wrapped() brings it back; it stands for the wrapped one there.
class PlainCursor {
 public:
  explicit PlainCursor(const std::uint32_t*) {}
  std::uint32_t value(std::ptrdiff_t step) const {
    return (symbol_ + static_cast<std::uint32_t>(step)) & 0xFFFF;
  }
  void move(std::ptrdiff_t step) { symbol_ += static_cast<std::uint32_t>(step); }
  std::uint32_t wrapped() const { return symbol_ & 0xFFFF; }
  void set(std::uint32_t symbol) { symbol_ = symbol; }

 private:
  std::uint32_t symbol_ = 0;
};

class TableCursor {
 public:
  // `table`: the value of symbol 0; kGuard values more in front of it and behind the last.
  explicit TableCursor(const std::uint32_t* table) : table_(table), at_(table) {}
  std::uint32_t value(std::ptrdiff_t step) const { return at_[step]; }
  void move(std::ptrdiff_t step) { at_ += step; }
  std::uint32_t wrapped() const { return static_cast<std::uint32_t>(at_ - table_) & 0xFFFF; }
  void set(std::uint32_t symbol) { at_ = table_ + symbol; }

 private:
  const std::uint32_t* table_;
  const std::uint32_t* at_;
};

// Decodes the symbol stream. A symbol that the table has no value for counts as one marked kNoValue, so that
// any symbol may be looked up and the mark is noticed at the end.
template <typename Cursor>
class SymbolReader {
 public:
  SymbolReader(std::span<const std::uint8_t> bytes, const std::uint32_t* table,
               std::span<std::uint16_t> pixels)
      : in_(bytes.data()),
        in_end_(bytes.data() + bytes.size()),
        cursor_(table),
        begin_(pixels.data()),
        out_(pixels.data()),
        out_end_(pixels.data() + pixels.size()) {}

  Decoded16z run() {
    if (in_end_ - in_ < 2) return result(kCut);
    cursor_.set(load_le<std::uint16_t>(in_));
    in_ += 2;
    if (!emit(1)) return result(kTooMany);
    while (in_ < in_end_) {
      const std::size_t room = std::min({kBlock, static_cast<std::size_t>(in_end_ - in_) / kMostBytes,
                                         static_cast<std::size_t>(out_end_ - out_) / kMostPixels});
      if (room > 0)
        run_block(room);
      else if (const char* fault = run_one(); fault != nullptr)
        return result(fault);
      cursor_.set(cursor_.wrapped());
    }
    return result(nullptr);
  }

 private:
  Decoded16z result(const char* fault) const {
    if (fault == nullptr && (seen_ & kNoValue) != 0) fault = kNotInTable;
    return {static_cast<std::size_t>(out_ - begin_), fault};
  }

  // There is room for `count` bytes or escapes. Few branches depend on what they are, since that cannot be
  // predicted: more pixels than a byte stands for are written, and overwritten by the next.
  void run_block(std::size_t count) {
    constexpr std::size_t kWritten = 16;
    const std::uint8_t* in = in_;
    std::uint16_t* out = out_;
    Cursor cursor = cursor_;
    std::uint32_t seen = seen_;
    for (; count > 0; --count) {
      const Step step = kSteps[*in++];
      const std::uint32_t first = cursor.value(step.first);
      cursor.move(step.last);
      const std::uint32_t last = cursor.value(0);
      seen |= first | last;
      std::fill_n(out, kWritten, static_cast<std::uint16_t>(last));
      if (step.pixels > kWritten) {
        std::fill_n(out + kWritten, kWritten, static_cast<std::uint16_t>(last));
        // Encoders end a run before that.
        if (step.pixels > 2 * kWritten)
          std::fill_n(out + 2 * kWritten, 2 * kWritten, static_cast<std::uint16_t>(last));
      }
      *out = static_cast<std::uint16_t>(first);
      out += step.pixels;
      if (!step.escape) continue;
      in += read_escape(in, cursor);
      seen |= cursor.value(0);
      *out++ = static_cast<std::uint16_t>(cursor.value(0));
    }
    in_ = in;
    out_ = out;
    cursor_ = cursor;
    seen_ = seen;
  }

  // The same with every bound checked.
  const char* run_one() {
    const Step step = kSteps[*in_++];
    if (step.pixels > 0) {
      cursor_.move(step.first);
      if (!emit(1)) return kTooMany;
      cursor_.move(step.last - step.first);
      if (!emit(step.pixels - std::size_t{1})) return kTooMany;
    }
    if (!step.escape) return nullptr;
    const auto left = static_cast<std::size_t>(in_end_ - in_);
    if (left < 1 || (in_[0] < 0x80 && left < 2)) return kCut;
    in_ += read_escape(in_, cursor_);
    return emit(1) ? nullptr : kTooMany;
  }

  // A larger difference in one byte, or the symbol itself in two. Returns their number.
  static std::size_t read_escape(const std::uint8_t* in, Cursor& cursor) {
    const unsigned d = in[0];
    if (d >= 0x80) {
      cursor.set((cursor.wrapped() + 192 - d) & 0xFFFF);
      return 1;
    }
    cursor.set(d << 8 | in[1]);
    return 2;
  }

  bool emit(std::size_t count) {
    if (static_cast<std::size_t>(out_end_ - out_) < count) return false;
    if (count > 0) seen_ |= cursor_.value(0);
    out_ = std::fill_n(out_, count, static_cast<std::uint16_t>(cursor_.value(0)));
    return true;
  }

  const std::uint8_t* in_;
  const std::uint8_t* const in_end_;
  Cursor cursor_;
  std::uint16_t* const begin_;
  std::uint16_t* out_;
  std::uint16_t* const out_end_;
  std::uint32_t seen_ = 0;  // all values together
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
  if (codec == Codec16z::plain) return SymbolReader<PlainCursor>(payload, nullptr, pixels).run();
  if (payload.size() < 2) return {0, kCut};
  const std::size_t count = load_le<std::uint16_t>(payload.data());
  if (count == 0 || payload.size() < 2 + 2 * count + 2) return {0, kNoTable};
  load_table(payload.subspan(2, 2 * count));
  return SymbolReader<TableCursor>(payload.subspan(2 + 2 * count), table_.data() + kGuard, pixels).run();
}

// Symbols wrap, so the guards are copies of the other end.
void Decoder16z::load_table(std::span<const std::uint8_t> values) {
  table_.resize(kGuard + kSymbols + kGuard, kNoValue);
  std::uint32_t* const table = table_.data() + kGuard;
  const std::size_t count = values.size() / 2;
  for (std::size_t i = 0; i < count; ++i) table[i] = load_le<std::uint16_t>(&values[2 * i]);
  std::fill(table + count, table + std::max(count, filled_), kNoValue);  // of the frame before
  filled_ = count;
  std::copy_n(table + kSymbols - kGuard, kGuard, table - kGuard);
  std::copy_n(table, kGuard, table + kSymbols);
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
