#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sources/hdf5_file.hpp"

namespace saccade {

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
