#pragma once

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace saccade {

/// Writes a small file in the format of NYU Depth V2, with libhdf5 as MATLAB lays it out.
class NyuWriter {
 public:
  static constexpr int kImages = 3, kHeight = 10, kWidth = 12;

  explicit NyuWriter(const std::filesystem::path& path) {
    // MATLAB puts a block of 512 bytes of its own before the file of HDF5.
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(creation, 512);
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
    H5Pclose(creation);
  }
  ~NyuWriter() { close(); }
  NyuWriter(const NyuWriter&) = delete;
  NyuWriter& operator=(const NyuWriter&) = delete;

  void close() {
    if (file_ >= 0) H5Fclose(file_);
    file_ = -1;
  }

  /// How the arrays written next are stored.
  struct Storage {
    std::vector<hsize_t> chunk{};  ///< of image, [colour,] column, row; none: one image
    bool chunked = true, shuffled = false, deflated = true, with_checksums = false;
    bool compact = false;  ///< within the description of the array
  };
  void set_storage(const Storage& storage) { storage_ = storage; }

  /// Puts bytes in the place of the chunk at a corner. Bit i of `skipped`: filter i was not used for them.
  void overwrite_chunk(const std::string& name, const std::vector<hsize_t>& corner,
                       const std::vector<std::uint8_t>& bytes, std::uint32_t skipped = 0) {
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    H5Dwrite_chunk(data, H5P_DEFAULT, skipped, corner.data(), bytes.size(), bytes.data());
    H5Dclose(data);
  }

  /// An array of `shape` whose value at image, row and column (and colour) is value(i, r, c, k); stored as
  /// image, [colour,] column, row. `stored_as`: the type in the file, that of Value if none is given.
  template <typename Value, typename Function>
  void put(const std::string& name, hid_t type, Function value, int colours = 0, int images = kImages,
           int height = kHeight, std::optional<hid_t> stored_as = {}) {
    std::vector<hsize_t> shape = {static_cast<hsize_t>(images), kWidth, static_cast<hsize_t>(height)};
    if (colours > 0) shape.insert(shape.begin() + 1, static_cast<hsize_t>(colours));
    std::vector<Value> values;
    for (int i = 0; i < images; ++i)
      for (int k = 0; k < std::max(colours, 1); ++k)
        for (int c = 0; c < kWidth; ++c)
          for (int r = 0; r < height; ++r) values.push_back(static_cast<Value>(value(i, r, c, k)));
    const int axes = static_cast<int>(shape.size());
    const hid_t space = H5Screate_simple(axes, shape.data(), nullptr), layout = H5Pcreate(H5P_DATASET_CREATE);
    std::vector<hsize_t> chunk = storage_.chunk;
    if (chunk.empty()) chunk = shape, chunk[0] = 1;
    if (storage_.chunked) H5Pset_chunk(layout, axes, chunk.data());
    if (storage_.compact) H5Pset_layout(layout, H5D_COMPACT);
    if (storage_.shuffled) H5Pset_shuffle(layout);
    if (storage_.deflated) H5Pset_deflate(layout, 3);
    if (storage_.with_checksums) H5Pset_fletcher32(layout);
    const hid_t data =
        H5Dcreate2(file_, name.c_str(), stored_as.value_or(type), space, H5P_DEFAULT, layout, H5P_DEFAULT);
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(data);
    H5Pclose(layout);
    H5Sclose(space);
  }

 private:
  hid_t file_ = -1;
  Storage storage_;
};

}  // namespace saccade
