#include "sources/hdf5_file.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

namespace saccade {

namespace {

// A library that was built for threads prints its messages on each thread on which this was not called.
void silence_messages() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

// Numbers as processors have them. A damaged file may describe others, of any size.
bool is_plain_number(hid_t type) {
  for (const hid_t plain :
       {H5T_STD_U8LE, H5T_STD_I8LE, H5T_STD_U16LE, H5T_STD_I16LE, H5T_STD_U32LE, H5T_STD_I32LE, H5T_STD_U64LE,
        H5T_STD_I64LE, H5T_STD_U16BE, H5T_STD_I16BE, H5T_STD_U32BE, H5T_STD_I32BE, H5T_IEEE_F32LE,
        H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_IEEE_F64BE})
    if (H5Tequal(type, plain) > 0) return true;
  return false;
}

hsize_t product_of(const std::vector<hsize_t>& sides, std::size_t first = 0) {
  hsize_t product = 1;
  for (std::size_t k = first; k < sides.size(); ++k)
    if (__builtin_mul_overflow(product, sides[k], &product))
      throw std::runtime_error("an array is too large");
  return product;
}

// The bytes of each number together again: all first bytes of the numbers come first, then all second ones.
void unshuffle(std::vector<std::uint8_t>& bytes, std::size_t number_bytes) {
  const std::size_t numbers = bytes.size() / number_bytes;
  const std::vector<std::uint8_t> apart = bytes;
  for (std::size_t k = 0; k < number_bytes; ++k)
    for (std::size_t i = 0; i < numbers; ++i) bytes[i * number_bytes + k] = apart[k * numbers + i];
}

}  // namespace

Hdf5Id open_hdf5(const std::filesystem::path& path) {
  silence_messages();
  // The file is only read, and the file systems of clusters often have no locks.
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

std::optional<Hdf5Images> Hdf5Images::open(const Hdf5Id& file, const std::string& name) {
  if (H5Lexists(file.get(), name.c_str(), H5P_DEFAULT) <= 0) return std::nullopt;
  Hdf5Images images;
  images.name_ = name;
  images.data_ = {H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose};
  if (!images.data_.valid()) throw std::runtime_error(name + " is not an array");
  images.type_ = {H5Dget_type(images.data_.get()), H5Tclose};
  if (!is_plain_number(images.type_.get())) throw std::runtime_error(name + " is not an array of numbers");
  const Hdf5Id space(H5Dget_space(images.data_.get()), H5Sclose);
  const int axes = H5Sget_simple_extent_ndims(space.get());
  if (axes <= 0) throw std::runtime_error(name + " has no shape");
  images.shape_.resize(static_cast<std::size_t>(axes));
  H5Sget_simple_extent_dims(space.get(), images.shape_.data(), nullptr);
  images.find_storage();
  return images;
}

// libhdf5 (1.10) believes the sizes in the description of an array, and copies that much out of whatever a
// chunk or the array itself holds. So chunks are taken as they are and decompressed here, and an array in one
// piece has to be as large as it says.
void Hdf5Images::find_storage() {
  const Hdf5Id creation(H5Dget_create_plist(data_.get()), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(creation.get()) > 0)
    throw std::runtime_error(name_ + " is kept in another file, which is not read");
  if (layout != H5D_CHUNKED) {
    const hsize_t bytes = product_of(shape_) * H5Tget_size(type_.get()),
                  stored = H5Dget_storage_size(data_.get());
    const bool never_written = stored == 0 && layout == H5D_CONTIGUOUS;  // zeros
    if (stored != bytes && !never_written)
      throw std::runtime_error(fmt::format("{} has {} bytes instead of {}", name_, stored, bytes));
    return;
  }
  const int filters = H5Pget_nfilters(creation.get());
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(creation.get(), static_cast<unsigned>(i), &flags, &values,
                                               nullptr, 0, nullptr, &config);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE)
      throw std::runtime_error(
          fmt::format("{} is compressed in a way that is not read (filter {} of HDF5)", name_, filter));
    filters_.push_back(filter);
  }
  chunk_.resize(shape_.size());
  if (H5Pget_chunk(creation.get(), static_cast<int>(chunk_.size()), chunk_.data()) !=
      static_cast<int>(chunk_.size()))
    throw std::runtime_error(name_ + " has chunks without a size");
  constexpr hsize_t kMostImages = 64, kMostChunks = 65536;
  std::vector<hsize_t> chunks;  // along each axis of an image
  for (std::size_t k = 0; k < shape_.size(); ++k) {
    if (chunk_[k] == 0) throw std::runtime_error(name_ + " has chunks without a size");
    if (k > 0) chunks.push_back(shape_[k] / chunk_[k] + (shape_[k] % chunk_[k] != 0 ? 1 : 0));
  }
  if (product_of(chunk_) / kMostImages > product_of(shape_, 1) || product_of(chunks) > kMostChunks)
    throw std::runtime_error(fmt::format("{} has chunks of more than {} images, or of less than 1/{} of one",
                                         name_, kMostImages, kMostChunks));
}

void Hdf5Images::read(hsize_t index, hid_t type, void* target) const {
  silence_messages();
  if (!chunk_.empty()) return read_chunks(index, type, static_cast<std::uint8_t*>(target));
  std::vector<hsize_t> begin(shape_.size(), 0), count = shape_;
  begin.at(0) = index;
  count.at(0) = 1;
  const Hdf5Id from(H5Dget_space(data_.get()), H5Sclose);
  const Hdf5Id to(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr) < 0 ||
      H5Dread(data_.get(), type, to.get(), from.get(), H5P_DEFAULT, target) < 0)
    throw std::runtime_error(name_ + " is damaged here");
}

void Hdf5Images::read_chunks(hsize_t index, hid_t type, std::uint8_t* target) const {
  std::vector<hsize_t> corner(shape_.size(), 0);
  corner[0] = index / chunk_[0] * chunk_[0];
  std::vector<std::uint8_t> numbers;
  for (;;) {
    decode_chunk(corner, type, numbers);
    copy_from_chunk(corner, index, H5Tget_size(type), numbers, target);
    std::size_t k = corner.size() - 1;  // the next chunk, by the last axis first
    for (; k > 0; --k) {
      corner[k] += chunk_[k];
      if (corner[k] < shape_[k]) break;
      corner[k] = 0;
    }
    if (k == 0) return;
  }
}

// The numbers of a chunk in the wanted type; zeros if the file has no such chunk.
void Hdf5Images::decode_chunk(const std::vector<hsize_t>& corner, hid_t type,
                              std::vector<std::uint8_t>& numbers) const {
  const std::runtime_error damaged(name_ + " is damaged here");
  const std::size_t count = product_of(chunk_), stored_bytes = H5Tget_size(type_.get());
  const std::size_t chunk_bytes = count * stored_bytes;
  numbers.assign(chunk_bytes, 0);
  hsize_t bytes = 0;
  if (H5Dget_chunk_storage_size(data_.get(), corner.data(), &bytes) < 0) throw damaged;
  if (bytes > 0) {
    constexpr hsize_t kMostOverhead = 1024;  // of a compressor that cannot compress
    if (bytes > chunk_bytes + chunk_bytes / 100 + kMostOverhead) throw damaged;
    std::vector<std::uint8_t> stored(bytes);
    std::uint32_t skipped = 0;  // bit i: filter i was not used
    if (H5Dread_chunk(data_.get(), H5P_DEFAULT, corner.data(), &skipped, stored.data()) < 0) throw damaged;
    for (std::size_t i = filters_.size(); i-- > 0;) {
      if ((skipped >> i & 1) != 0) continue;
      if (filters_[i] == H5Z_FILTER_DEFLATE) {
        const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflate(
            libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
        if (!inflate) throw std::bad_alloc();
        std::vector<std::uint8_t> inflated(chunk_bytes);
        if (libdeflate_zlib_decompress(inflate.get(), stored.data(), stored.size(), inflated.data(),
                                       inflated.size(), nullptr) != LIBDEFLATE_SUCCESS)
          throw damaged;
        stored.swap(inflated);
      } else {
        unshuffle(stored, stored_bytes);
      }
    }
    if (stored.size() != chunk_bytes) throw damaged;
    numbers.swap(stored);
  }
  numbers.resize(count * std::max(stored_bytes, H5Tget_size(type)));
  if (H5Tconvert(type_.get(), type, count, numbers.data(), nullptr, H5P_DEFAULT) < 0) throw damaged;
}

// The part of a chunk that lies in image `index`, row by row of the last axis.
void Hdf5Images::copy_from_chunk(const std::vector<hsize_t>& corner, hsize_t index, std::size_t number_bytes,
                                 const std::vector<std::uint8_t>& numbers, std::uint8_t* target) const {
  const std::size_t last = shape_.size() - 1;
  const auto inside = [&](std::size_t k) { return std::min(chunk_[k], shape_[k] - corner[k]); };
  std::vector<hsize_t> at(shape_.size(), 0);  // in the chunk
  at[0] = index - corner[0];
  const std::size_t row = last > 0 ? inside(last) : 1;
  std::size_t rows = 1;
  for (std::size_t k = 1; k < last; ++k) rows *= inside(k);
  for (; rows > 0; --rows) {
    std::size_t from = at[0], to = 0;
    for (std::size_t k = 1; k <= last; ++k) {
      from = from * chunk_[k] + at[k];
      to = to * shape_[k] + corner[k] + at[k];
    }
    std::memcpy(target + to * number_bytes, numbers.data() + from * number_bytes, row * number_bytes);
    for (std::size_t k = last; k-- > 1;) {
      if (++at[k] < inside(k)) break;
      at[k] = 0;
    }
  }
}

}  // namespace saccade
