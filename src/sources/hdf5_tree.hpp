#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "oni/bytes.hpp"
#include "sources/hdf5_file.hpp"
#include "sources/record_cursor.hpp"

namespace saccade {

/// A node of a B-tree of a file: for each child a key of the given size, then its address.
struct Hdf5TreeNode {
  static constexpr int kMostLevels = 32;  ///< of a tree; a damaged one could go round in circles

  int level = 0;
  Hdf5File::Bytes entries;
  std::size_t count = 0, key_bytes = 0;

  Hdf5TreeNode(const Hdf5File& file, std::uint64_t address, std::uint8_t type, std::size_t size_of_key)
      : key_bytes(size_of_key) {
    constexpr std::uint64_t kHeader = 24;
    const Hdf5File::Bytes header = file.bytes(address, kHeader);
    RecordCursor cursor(header);
    cursor.expect("TREE");
    if (cursor.take<std::uint8_t>() != type) throw std::runtime_error("a tree is of another kind");
    level = cursor.take<std::uint8_t>();
    count = cursor.take<std::uint16_t>();
    entries = file.bytes(address + kHeader, count * (key_bytes + 8));
  }
  std::span<const std::uint8_t> key(std::size_t i) const {
    return std::span(entries).subspan(i * (key_bytes + 8), key_bytes);
  }
  std::uint64_t child(std::size_t i) const {
    return load_le<std::uint64_t>(entries.data() + i * (key_bytes + 8) + key_bytes);
  }
};

}  // namespace saccade
