#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "oni/input_file.hpp"

namespace saccade {

/// A file in the first form of HDF5 ("HDF5 File Format Specification", version 1.1), which MATLAB 7.3 writes
/// and libhdf5 and h5py do unless they are asked for their latest: superblock 0 or 1, groups by symbol
/// tables, and arrays in one piece or in chunks that a B-tree finds. Every address and length in it is
/// checked before it is used. One thread at a time.
class Hdf5File {
 public:
  using Bytes = std::vector<std::uint8_t>;
  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};  ///< the address of what was never written

  /// Throws Error (unreadable) if the file cannot be opened, and std::runtime_error with the reason if it is
  /// not such a file.
  explicit Hdf5File(const std::filesystem::path& path);

  /// The address of an object of the root group; std::nullopt if there is none of this name. Throws
  /// std::runtime_error if the group is damaged.
  std::optional<std::uint64_t> find(const std::string& name) const;

  /// A message of an object's header, which describes a property of it.
  struct Message {
    std::uint16_t type = 0;
    bool elsewhere = false;  ///< the bytes only say where in the file it is
    Bytes bytes{};
  };
  /// Those of the object at `address`. Throws std::runtime_error.
  std::vector<Message> messages(std::uint64_t address) const;

  /// `size` bytes at an address. Throws std::runtime_error if they are not in the file.
  Bytes bytes(std::uint64_t address, std::uint64_t size) const;

  /// How many bytes of the file are missing at its end.
  std::uint64_t missing() const { return missing_; }

 private:
  InputFile file_;
  std::uint64_t base_ = 0;  // position of address 0
  std::uint64_t root_ = 0, missing_ = 0;
};

}  // namespace saccade
