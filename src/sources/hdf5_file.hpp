#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace saccade {

/// Owns an identifier of libhdf5 and closes it. Negative = none.
class Hdf5Id {
 public:
  Hdf5Id() = default;
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }

  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// A numeric array of a file whose first axis counts images: whole, or in chunks, which may be compressed by
/// deflate, shuffled or not.
class Hdf5Images {
 public:
  /// std::nullopt if the file has no such array. Throws std::runtime_error if it is not an array of numbers,
  /// or is stored in a way that is not read.
  static std::optional<Hdf5Images> open(const Hdf5Id& file, const std::string& name);

  const std::vector<hsize_t>& shape() const { return shape_; }

  /// Reads image `index` as numbers of `type` (one of libhdf5's native types) into `target`, which has room
  /// for all but the first axis. Throws std::runtime_error if the file is damaged there.
  void read(hsize_t index, hid_t type, void* target) const;

 private:
  void find_storage();
  void read_chunks(hsize_t index, hid_t type, std::uint8_t* target) const;
  void decode_chunk(const std::vector<hsize_t>& corner, hid_t type, std::vector<std::uint8_t>& numbers) const;
  void copy_from_chunk(const std::vector<hsize_t>& corner, hsize_t index, std::size_t number_bytes,
                       const std::vector<std::uint8_t>& numbers, std::uint8_t* target) const;

  std::string name_;
  Hdf5Id data_, type_;
  std::vector<hsize_t> shape_;
  std::vector<hsize_t> chunk_;         ///< shape of a chunk; empty: the array is in one piece
  std::vector<H5Z_filter_t> filters_;  ///< of the chunks, in the order of writing
};

/// Opens a file for reading. libhdf5's own messages on standard error are switched off, here and in read().
/// An invalid identifier if it is not an HDF5 file.
Hdf5Id open_hdf5(const std::filesystem::path& path);

}  // namespace saccade
