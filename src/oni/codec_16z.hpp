#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace saccade {

/// The 16-bit depth codecs: 16zP codes the pixels themselves, 16zT indices into a table of the frame's
/// distinct values, which makes neighbouring depths of a coarse sensor neighbouring indices. Both code a
/// sequence of 16-bit symbols, each as a small difference from the last, as a run, or in full.
enum class Codec16z { plain, table };

/// What came out of a payload.
struct [[nodiscard]] Decoded16z {
  std::size_t pixels = 0;       ///< written
  const char* fault = nullptr;  ///< what is wrong with the payload; nullptr = it is whole
};

/// Decodes without reading or writing outside of its arguments, whatever the payload holds. Keeps the scratch
/// memory of the table between frames (264 KiB). Thread safety: one decode() at a time per object.
class Decoder16z {
 public:
  /// Decodes `payload` into `pixels`. A payload with more pixels than fit is a fault; one with fewer is not,
  /// the caller compares the count.
  Decoded16z decode(Codec16z codec, std::span<const std::uint8_t> payload, std::span<std::uint16_t> pixels);

 private:
  void load_table(std::span<const std::uint8_t> values);

  std::vector<std::uint32_t> table_;  // of every symbol, and some beyond
  std::size_t filled_ = 0;            // entries with a value, at the front
};

/// Codes frames so that decoding gives the same pixels again, bit for bit. Keeps scratch memory between
/// frames. Differs from OpenNI's encoder at the end of a frame, where that one writes the pending nibble in
/// front of the pending run and so alters up to 28 pixels, and for large depths, which that one replaces.
/// Thread safety: one encode() at a time per object.
class Encoder16z {
 public:
  /// Appends the coded `pixels` (not empty) to `payload`. Returns false, and appends nothing, for the one
  /// kind of frame the format cannot hold: a jump to a symbol >= 32768, that is to such a depth in 16zP, or a
  /// frame of more than 32768 distinct depths in 16zT.
  [[nodiscard]] bool encode(Codec16z codec, std::span<const std::uint16_t> pixels,
                            std::vector<std::uint8_t>& payload);

 private:
  void build_table(std::span<const std::uint16_t> pixels);

  std::vector<std::uint16_t> index_of_;  // of each value in values_
  std::vector<std::uint16_t> values_;    // the distinct pixels, ascending
};

/// The most bytes that encode() appends for so many pixels.
constexpr std::size_t max_size_16z(std::size_t pixels) { return 3 * pixels + 2 + 2 + 2 * 65536; }

/// False if a payload of `bytes` cannot possibly hold `pixels`, since a byte gives at most 60 of them.
constexpr bool may_hold_16z(std::size_t bytes, std::size_t pixels) { return pixels / 60 <= bytes; }

}  // namespace saccade
