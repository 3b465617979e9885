#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace saccade {

/// The 16-bit depth codecs (README 4.2): 16zP codes the pixels themselves, 16zT indices into a table of the
/// frame's distinct values, so that successive depths of a coarse sensor become successive indices. Both code
/// a sequence of 16-bit symbols, each as a small difference from the previous one, as a run, or in full.
enum class Codec16z { plain, table };

constexpr std::size_t kSymbols16z = 65536;  ///< that there are

/// The result of decoding a payload.
struct [[nodiscard]] Decoded16z {
  std::size_t pixels = 0;       ///< number written
  const char* fault = nullptr;  ///< the fault of the payload; nullptr = none
};

/// Decodes any payload without access outside its arguments. Keeps the memory of the table between frames
/// (264 KiB). Thread safety: one decode() at a time per object.
class Decoder16z {
 public:
  /// Decodes `payload` into `pixels`. More pixels than fit are a fault, but fewer are not:
  /// the caller compares the number.
  Decoded16z decode(Codec16z codec, std::span<const std::uint8_t> payload, std::span<std::uint16_t> pixels);

 private:
  void load_table(std::span<const std::uint8_t> values);

  std::vector<std::uint32_t> table_;  // value of every symbol, with a guard at either end
  std::size_t filled_ = 0;            // entries with a value, at the front
};

/// Encodes frames without loss, bit for bit. Keeps scratch memory between frames. Differs from OpenNI's
/// encoder in two places where that one alters pixels: at the end of a frame and for large depths (README
/// 11). Thread safety: one encode() at a time per object.
class Encoder16z {
 public:
  /// Appends the encoded `pixels` (not empty) to `payload`. Returns false, and appends nothing, if the format
  /// cannot hold the frame: it jumps to a symbol >= 32768, that is to such a depth in 16zP, and in 16zT only
  /// in frames of more than 32768 distinct depths.
  [[nodiscard]] bool encode(Codec16z codec, std::span<const std::uint16_t> pixels,
                            std::vector<std::uint8_t>& payload);

 private:
  void build_table(std::span<const std::uint16_t> pixels);

  std::vector<std::uint16_t> index_of_;  // of each value in values_
  std::vector<std::uint16_t> values_;    // the distinct pixels, ascending
};

/// The most bytes that encode() appends for `pixels` pixels.
constexpr std::size_t max_size_16z(std::size_t pixels) { return 3 * pixels + 2 + 2 + 2 * kSymbols16z; }

/// False if a payload of `bytes` is too short for `pixels`: a byte holds at most 60.
constexpr bool may_hold_16z(std::size_t bytes, std::size_t pixels) { return pixels / 60 <= bytes; }

}  // namespace saccade
