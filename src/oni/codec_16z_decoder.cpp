// Decoding of 16zP and 16zT (README 4.2).
#include <algorithm>
#include <array>

#include "oni/bytes.hpp"
#include "oni/codec_16z.hpp"
#include "oni/codec_faults.hpp"

namespace saccade {
namespace {

constexpr std::uint32_t kNoValue = 1u << 31;
constexpr const char* kNoTable = "the table of values is damaged";
constexpr const char* kNotInTable = "a pixel that is not in the table of values";

// The effect of a byte: it emits one symbol, and then `pixels` - 1 times another. `first` and `last` are
// their differences from the symbol before the byte; 0 for a run. For an escape, whose own code follows, this
// is the effect of the high nibble in front of it, if there is one.
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

// The fast loop decodes this many codes (bytes, or escapes with their bytes) without bounds checks.
constexpr std::size_t kBlock = 64;
constexpr std::size_t kMostBytes = 3;          // of one code
constexpr std::size_t kMostPixelsOfCode = 64;  // that one code may write to
// The largest change of a symbol within a block; an escape sets the symbol and wraps it.
constexpr std::size_t kGuard = 16 * kBlock;

// The current symbol and its pixel, for 16zP and 16zT. A symbol may leave 0..65535 by kGuard on either side
// before set(wrapped()) brings it back, and has the pixel of the wrapped symbol there.
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
  // `table`: points to the value of symbol 0; kGuard more values lie before it and after the last.
  explicit TableCursor(const std::uint32_t* table) : table_(table), at_(table) {}
  std::uint32_t value(std::ptrdiff_t step) const { return at_[step]; }
  void move(std::ptrdiff_t step) { at_ += step; }
  std::uint32_t wrapped() const { return static_cast<std::uint32_t>(at_ - table_) & 0xFFFF; }
  void set(std::uint32_t symbol) { at_ = table_ + symbol; }

 private:
  const std::uint32_t* table_;
  const std::uint32_t* at_;
};

// Decodes the symbol stream. A symbol beyond the table has a value marked kNoValue, so any symbol may be
// looked up, and the mark is found at the end.
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
    if (in_end_ - in_ < 2) return result(kTruncated);
    cursor_.set(load_le<std::uint16_t>(in_));
    in_ += 2;
    if (!emit(1)) return result(kTooManyPixels);
    while (in_ < in_end_) {
      const std::size_t room = std::min({kBlock, static_cast<std::size_t>(in_end_ - in_) / kMostBytes,
                                         static_cast<std::size_t>(out_end_ - out_) / kMostPixelsOfCode});
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

  // Decodes `count` codes; the caller has checked that their bytes and pixels fit. Few branches depend on the
  // codes, since those cannot be predicted: it writes more pixels than a code has, which the next overwrites.
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
        // Encoders write no longer run.
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

  // Decodes one code with all bounds checked. Returns the fault, nullptr = none.
  const char* run_one() {
    const Step step = kSteps[*in_++];
    if (step.pixels > 0) {
      cursor_.move(step.first);
      if (!emit(1)) return kTooManyPixels;
      cursor_.move(step.last - step.first);
      if (!emit(step.pixels - std::size_t{1})) return kTooManyPixels;
    }
    if (!step.escape) return nullptr;
    const auto left = static_cast<std::size_t>(in_end_ - in_);
    if (left < 1 || (in_[0] < 0x80 && left < 2)) return kTruncated;
    in_ += read_escape(in_, cursor_);
    return emit(1) ? nullptr : kTooManyPixels;
  }

  // A larger difference in one byte, or the symbol itself in two. Returns the number of bytes.
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
  std::uint32_t seen_ = 0;  // bitwise or of all values
};

}  // namespace

Decoded16z Decoder16z::decode(Codec16z codec, std::span<const std::uint8_t> payload,
                              std::span<std::uint16_t> pixels) {
  if (codec == Codec16z::plain) return SymbolReader<PlainCursor>(payload, nullptr, pixels).run();
  if (payload.size() < 2) return {0, kTruncated};
  const std::size_t count = load_le<std::uint16_t>(payload.data());
  if (count == 0 || payload.size() < 2 + 2 * count + 2) return {0, kNoTable};
  load_table(payload.subspan(2, 2 * count));
  return SymbolReader<TableCursor>(payload.subspan(2 + 2 * count), table_.data() + kGuard, pixels).run();
}

// Symbols wrap, so each guard is a copy of the other end.
void Decoder16z::load_table(std::span<const std::uint8_t> values) {
  table_.resize(kGuard + kSymbols16z + kGuard, kNoValue);
  std::uint32_t* const table = table_.data() + kGuard;
  const std::size_t count = values.size() / 2;
  for (std::size_t i = 0; i < count; ++i) table[i] = load_le<std::uint16_t>(&values[2 * i]);
  std::fill(table + count, table + std::max(count, filled_), kNoValue);  // values of the previous frame
  filled_ = count;
  std::copy_n(table + kSymbols16z - kGuard, kGuard, table - kGuard);
  std::copy_n(table, kGuard, table + kSymbols16z);
}

}  // namespace saccade
