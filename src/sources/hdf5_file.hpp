#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
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

/// A numeric array of a file whose first axis counts images: whole, or in chunks, which may be compressed by
/// deflate, shuffled or not.
class Hdf5Images {
 public:
  /// std::nullopt if the file has no such array. Throws std::runtime_error if it is not an array of numbers,
  /// or is stored in a way that is not read. `file` has to outlive it.
  static std::optional<Hdf5Images> open(const Hdf5File& file, const std::string& name);

  const std::vector<std::uint64_t>& shape() const { return shape_; }

  /// Reads image `index` into `target`, whose size is the product of all but the first side. Numbers that the
  /// type does not have become the nearest that it has, what is no number 0 in an integer. What was never
  /// written is 0. Throws std::runtime_error if the file is damaged there.
  void read(std::uint64_t index, std::span<float> target) const;
  void read(std::uint64_t index, std::span<std::uint8_t> target) const;
  void read(std::uint64_t index, std::span<std::uint16_t> target) const;

 private:
  enum class Layout { compact, whole, chunked };
  enum class Kind { unsigned_integer, signed_integer, real };
  struct Chunk {
    std::uint64_t address = 0;
    std::uint32_t size = 0;     // bytes in the file
    std::uint32_t skipped = 0;  // bit i: filter i was not used
  };

  Hdf5Images(const Hdf5File& file, std::string name) : file_(&file), name_(std::move(name)) {}

  void describe_shape(const Hdf5File::Bytes& message);
  void describe_number(const Hdf5File::Bytes& message);
  void describe_layout(const Hdf5File::Bytes& message);
  void describe_filters(const Hdf5File::Bytes& message);
  void check_storage() const;

  Hdf5File::Bytes stored_image(std::uint64_t index) const;
  std::optional<Chunk> find_chunk(const std::vector<std::uint64_t>& corner) const;
  Hdf5File::Bytes decoded(const Chunk& chunk) const;
  void copy_from_chunk(const std::vector<std::uint64_t>& corner, std::uint64_t index,
                       const Hdf5File::Bytes& chunk, Hdf5File::Bytes& image) const;
  template <typename To>
  void read_as(std::uint64_t index, std::span<To> target) const;

  const Hdf5File* file_;
  std::string name_;
  std::vector<std::uint64_t> shape_;
  Kind kind_ = Kind::real;
  std::size_t number_bytes_ = 0;  // 1, 2, 4 or 8
  bool big_endian_ = false;
  Layout layout_ = Layout::whole;
  Hdf5File::Bytes compact_;             // all of the array
  std::uint64_t address_ = 0;           // of the array, or of the tree of its chunks
  std::uint64_t stored_bytes_ = 0;      // of an array in one piece
  std::vector<std::uint64_t> chunk_;    // its shape
  std::vector<std::uint16_t> filters_;  // of the chunks, in the order of writing
};

}  // namespace saccade
