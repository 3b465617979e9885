#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace saccade {

/// The chunks of a bag that were decompressed last. Depth and colour of one moment may be in two.
class ChunkCache {
 public:
  /// Fills the bytes of a chunk by its number. May throw std::runtime_error.
  using Load = std::function<void(std::uint64_t number, std::vector<std::uint8_t>& bytes)>;

  /// The bytes of a chunk, valid until the next call but one.
  std::span<const std::uint8_t> get(std::uint64_t number, const Load& load) {
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (slots_[i].filled && slots_[i].number == number) {
        newest_ = i;
        return slots_[i].bytes;
      }
    newest_ = (newest_ + 1) % slots_.size();
    Slot& slot = slots_[newest_];
    slot.filled = false;
    load(number, slot.bytes);
    slot.number = number;
    slot.filled = true;
    return slot.bytes;
  }

 private:
  struct Slot {
    std::uint64_t number = 0;
    bool filled = false;
    std::vector<std::uint8_t> bytes;
  };
  std::array<Slot, 2> slots_;
  std::size_t newest_ = 0;
};

}  // namespace saccade
