#include "sources/hdf5_images.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "oni/bytes.hpp"
#include "sources/hdf5_tree.hpp"
#include "sources/record_cursor.hpp"

namespace saccade {
namespace {

// The messages of an object's header that describe an array.
constexpr std::uint16_t kShape = 0x01, kNumber = 0x03, kExternalFiles = 0x07, kLayout = 0x08, kFilters = 0x0b;
constexpr std::uint16_t kDeflate = 1, kShuffle = 2;

std::uint64_t product_of(const std::vector<std::uint64_t>& sides, std::size_t first = 0) {
  std::uint64_t product = 1;
  for (std::size_t k = first; k < sides.size(); ++k)
    if (__builtin_mul_overflow(product, sides[k], &product))
      throw std::runtime_error("an array is too large");
  return product;
}

// The bytes of each number together again: all first bytes of the numbers come first, then all second ones.
void unshuffle(Hdf5File::Bytes& bytes, std::size_t number_bytes) {
  const std::size_t numbers = bytes.size() / number_bytes;
  const Hdf5File::Bytes apart = bytes;
  for (std::size_t k = 0; k < number_bytes; ++k)
    for (std::size_t i = 0; i < numbers; ++i) bytes[i * number_bytes + k] = apart[k * numbers + i];
}

template <typename To, typename From>
To nearest(From value) {
  if constexpr (std::is_floating_point_v<To>) {
    if constexpr (sizeof(From) > sizeof(To) && std::is_floating_point_v<From>)
      if (std::abs(value) > static_cast<From>(std::numeric_limits<To>::max()))
        return std::copysign(std::numeric_limits<To>::infinity(), static_cast<To>(value > 0 ? 1 : -1));
    return static_cast<To>(value);
  } else if constexpr (std::is_floating_point_v<From>) {
    if (!(value > 0)) return 0;  // nor what is no number; To has no sign
    constexpr auto kMost = static_cast<From>(std::numeric_limits<To>::max());
    return value >= kMost ? std::numeric_limits<To>::max() : static_cast<To>(value);
  } else {
    if (std::cmp_less(value, 0)) return 0;
    return std::cmp_greater(value, std::numeric_limits<To>::max()) ? std::numeric_limits<To>::max()
                                                                   : static_cast<To>(value);
  }
}

template <typename From, typename To>
void convert(const Hdf5File::Bytes& from, bool big_endian, std::span<To> to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    std::array<std::uint8_t, sizeof(From)> bytes;
    std::memcpy(bytes.data(), from.data() + i * sizeof(From), sizeof(From));
    if (big_endian) std::ranges::reverse(bytes);
    to[i] = nearest<To>(std::bit_cast<From>(bytes));
  }
}

}  // namespace

std::optional<Hdf5Images> Hdf5Images::open(const Hdf5File& file, const std::string& name) {
  const auto address = file.find(name);
  if (!address) return std::nullopt;
  Hdf5Images images(file, name);
  const auto messages = file.messages(*address);
  const auto message = [&](std::uint16_t type) -> const Hdf5File::Message* {
    const auto found = std::ranges::find(messages, type, &Hdf5File::Message::type);
    if (found == messages.end()) return nullptr;
    if (found->elsewhere) throw std::runtime_error(name + " is described elsewhere, which is not read");
    return &*found;
  };
  const auto *shape = message(kShape), *number = message(kNumber), *layout = message(kLayout),
             *filters = message(kFilters);
  if (shape == nullptr || number == nullptr || layout == nullptr)
    throw std::runtime_error(name + " is not an array");
  if (message(kExternalFiles) != nullptr)
    throw std::runtime_error(name + " is kept in another file, which is not read");
  images.describe_shape(shape->bytes);
  images.describe_number(number->bytes);
  if (filters != nullptr) images.describe_filters(filters->bytes);
  images.describe_layout(layout->bytes);
  images.check_storage();
  return images;
}

void Hdf5Images::describe_shape(const Hdf5File::Bytes& message) {
  RecordCursor cursor(message);
  const auto version = cursor.take<std::uint8_t>(), axes = cursor.take<std::uint8_t>();
  cursor.skip(version == 1 ? 6 : 2);
  for (int k = 0; k < axes; ++k) shape_.push_back(cursor.take<std::uint64_t>());
  if (shape_.empty()) throw std::runtime_error(name_ + " has no shape");
}

// Numbers as processors have them. A damaged file may describe others, of any size.
void Hdf5Images::describe_number(const Hdf5File::Bytes& message) {
  RecordCursor cursor(message);
  const int kind = cursor.take<std::uint8_t>() & 0xf;
  const auto flags = cursor.take<std::uint8_t>();
  cursor.skip(2);
  const auto size = cursor.take<std::uint32_t>();
  const std::runtime_error other(name_ + " is not an array of numbers");
  if (kind > 1) throw other;
  const auto offset = cursor.take<std::uint16_t>(), bits = cursor.take<std::uint16_t>();
  if ((size != 1 && size != 2 && size != 4 && size != 8) || offset != 0 || bits != 8 * size) throw other;
  number_bytes_ = size;
  big_endian_ = (flags & 1) != 0;
  if (kind == 0) {
    kind_ = (flags & 8) != 0 ? Kind::signed_integer : Kind::unsigned_integer;
    return;
  }
  // IEEE 754: where the exponent and the mantissa begin, their bits, and the bias.
  std::array<std::uint8_t, 4> parts{};
  std::ranges::copy(cursor.take_bytes(parts.size()), parts.begin());
  const auto bias = cursor.take<std::uint32_t>();
  const bool single = parts == std::array<std::uint8_t, 4>{23, 8, 0, 23} && bias == 127 && size == 4;
  const bool twice = parts == std::array<std::uint8_t, 4>{52, 11, 0, 52} && bias == 1023 && size == 8;
  if ((flags & 0x40) != 0 || (!single && !twice)) throw other;
  kind_ = Kind::real;
}

void Hdf5Images::describe_filters(const Hdf5File::Bytes& message) {
  RecordCursor cursor(message);
  const auto version = cursor.take<std::uint8_t>(), count = cursor.take<std::uint8_t>();
  if (version == 1) cursor.skip(6);
  for (int i = 0; i < count; ++i) {
    const auto filter = cursor.take<std::uint16_t>();
    if (filter != kDeflate && filter != kShuffle)
      throw std::runtime_error(
          fmt::format("{} is compressed in a way that is not read (filter {} of HDF5)", name_, filter));
    filters_.push_back(filter);
    const std::size_t name_bytes = version == 1 ? cursor.take<std::uint16_t>() : 0;
    cursor.skip(2);
    const std::size_t values = cursor.take<std::uint16_t>();
    cursor.skip((name_bytes + 7) / 8 * 8);
    cursor.skip(4 * (version == 1 ? (values + 1) / 2 * 2 : values));
  }
}

void Hdf5Images::describe_layout(const Hdf5File::Bytes& message) {
  RecordCursor cursor(message);
  if (const auto version = cursor.take<std::uint8_t>(); version != 3)
    throw std::runtime_error(fmt::format("{} is stored in another form of HDF5, which is not read", name_));
  switch (cursor.take<std::uint8_t>()) {
    case 0: {
      layout_ = Layout::compact;
      stored_bytes_ = cursor.take<std::uint16_t>();
      const auto content = cursor.take_bytes(stored_bytes_);
      compact_.assign(content.begin(), content.end());
      return;
    }
    case 1:
      layout_ = Layout::whole;
      address_ = cursor.take<std::uint64_t>();
      stored_bytes_ = cursor.take<std::uint64_t>();
      return;
    case 2: {
      layout_ = Layout::chunked;
      const std::size_t axes = cursor.take<std::uint8_t>();  // and one for the bytes of a number
      address_ = cursor.take<std::uint64_t>();
      if (axes != shape_.size() + 1) throw std::runtime_error(name_ + " has chunks of another shape");
      for (std::size_t k = 0; k < shape_.size(); ++k) chunk_.push_back(cursor.take<std::uint32_t>());
      if (cursor.take<std::uint32_t>() != number_bytes_)
        throw std::runtime_error(name_ + " has chunks of other numbers");
      return;
    }
    default:
      throw std::runtime_error(name_ + " is stored in a way that is not read");
  }
}

void Hdf5Images::check_storage() const {
  if (layout_ != Layout::chunked) {
    std::uint64_t bytes = 0;
    if (__builtin_mul_overflow(product_of(shape_), number_bytes_, &bytes))
      throw std::runtime_error("an array is too large");
    if (stored_bytes_ != bytes)
      throw std::runtime_error(fmt::format("{} has {} bytes instead of {}", name_, stored_bytes_, bytes));
    return;
  }
  constexpr std::uint64_t kMostImages = 64, kMostChunks = 65536;
  std::vector<std::uint64_t> chunks;  // along each axis of an image
  for (std::size_t k = 0; k < shape_.size(); ++k) {
    if (chunk_[k] == 0) throw std::runtime_error(name_ + " has chunks without a size");
    if (k > 0) chunks.push_back(shape_[k] / chunk_[k] + (shape_[k] % chunk_[k] != 0 ? 1 : 0));
  }
  if (product_of(chunk_) / kMostImages > product_of(shape_, 1) || product_of(chunks) > kMostChunks)
    throw std::runtime_error(fmt::format("{} has chunks of more than {} images, or of less than 1/{} of one",
                                         name_, kMostImages, kMostChunks));
}

void Hdf5Images::read(std::uint64_t index, std::span<float> target) const { read_as(index, target); }
void Hdf5Images::read(std::uint64_t index, std::span<std::uint8_t> target) const { read_as(index, target); }
void Hdf5Images::read(std::uint64_t index, std::span<std::uint16_t> target) const { read_as(index, target); }

template <typename To>
void Hdf5Images::read_as(std::uint64_t index, std::span<To> target) const {
  if (index >= shape_[0] || target.size() != product_of(shape_, 1))
    throw std::invalid_argument("not an image of " + name_);
  const Hdf5File::Bytes image = stored_image(index);
  const auto as = [&]<typename Unsigned, typename Signed>(Unsigned, Signed) {
    if (kind_ == Kind::unsigned_integer)
      convert<Unsigned>(image, big_endian_, target);
    else
      convert<Signed>(image, big_endian_, target);
  };
  if (kind_ == Kind::real && number_bytes_ == 4)
    convert<float>(image, big_endian_, target);
  else if (kind_ == Kind::real)
    convert<double>(image, big_endian_, target);
  else if (number_bytes_ == 1)
    as(std::uint8_t{}, std::int8_t{});
  else if (number_bytes_ == 2)
    as(std::uint16_t{}, std::int16_t{});
  else if (number_bytes_ == 4)
    as(std::uint32_t{}, std::int32_t{});
  else
    as(std::uint64_t{}, std::int64_t{});
}

// The bytes of an image as the file has them, without compression.
Hdf5File::Bytes Hdf5Images::stored_image(std::uint64_t index) const {
  const std::uint64_t size = product_of(shape_, 1) * number_bytes_;
  Hdf5File::Bytes image(size, 0);
  if (layout_ == Layout::compact) {
    std::copy_n(compact_.begin() + static_cast<std::ptrdiff_t>(index * size), size, image.begin());
    return image;
  }
  if (address_ == Hdf5File::kNowhere) return image;
  try {
    if (layout_ == Layout::whole) {
      std::uint64_t position = 0;
      if (__builtin_add_overflow(address_, index * size, &position)) throw std::runtime_error("no address");
      return file_->bytes(position, size);
    }
    std::vector<std::uint64_t> corner(shape_.size(), 0);
    corner[0] = index / chunk_[0] * chunk_[0];
    for (;;) {
      if (const auto chunk = find_chunk(corner)) copy_from_chunk(corner, index, decoded(*chunk), image);
      std::size_t k = corner.size() - 1;  // the next chunk, by the last axis first
      for (; k > 0; --k) {
        corner[k] += chunk_[k];
        if (corner[k] < shape_[k]) break;
        corner[k] = 0;
      }
      if (k == 0) return image;
    }
  } catch (const std::runtime_error&) {
    throw std::runtime_error(name_ +
                             (file_->missing() > 0 ? " is damaged or cut off here" : " is damaged here"));
  }
}

// Chunks are sorted by their corners.
std::optional<Hdf5Images::Chunk> Hdf5Images::find_chunk(const std::vector<std::uint64_t>& corner) const {
  const std::size_t key_bytes = 8 + 8 * (corner.size() + 1);  // size, skipped filters, corner and a 0
  const auto corner_of = [&](const Hdf5TreeNode& node, std::size_t i) {
    std::vector<std::uint64_t> of(corner.size());
    std::memcpy(of.data(), node.key(i).data() + 8, 8 * of.size());
    return of;
  };
  std::uint64_t address = address_;
  for (int above = Hdf5TreeNode::kMostLevels;;) {
    const Hdf5TreeNode node(*file_, address, 1, key_bytes);
    if (node.level >= above) throw std::runtime_error("a tree is damaged");
    above = node.level;
    std::size_t low = 0, high = node.count;  // the last chunk that does not come after the wanted one
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (corner_of(node, middle) <= corner)
        low = middle + 1;
      else
        high = middle;
    }
    if (low == 0) return std::nullopt;
    address = node.child(low - 1);
    if (node.level > 0) continue;
    if (corner_of(node, low - 1) != corner) return std::nullopt;
    const std::uint8_t* key = node.key(low - 1).data();
    return Chunk{address, load_le<std::uint32_t>(key), load_le<std::uint32_t>(key + 4)};
  }
}

Hdf5File::Bytes Hdf5Images::decoded(const Chunk& chunk) const {
  const std::runtime_error damaged("a chunk is damaged");
  const std::size_t chunk_bytes = product_of(chunk_) * number_bytes_;
  // No compressor does better, nor needs more than this for what it cannot compress.
  constexpr std::size_t kBestDeflate = 1032, kMostOverhead = 1024;
  if (chunk.size < chunk_bytes / kBestDeflate || chunk.size > chunk_bytes + chunk_bytes / 100 + kMostOverhead)
    throw damaged;
  Hdf5File::Bytes bytes = file_->bytes(chunk.address, chunk.size);
  for (std::size_t i = filters_.size(); i-- > 0;) {
    if (i < 32 && (chunk.skipped >> i & 1) != 0) continue;
    if (filters_[i] == kShuffle) {
      unshuffle(bytes, number_bytes_);
      continue;
    }
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflate(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!inflate) throw std::bad_alloc();
    Hdf5File::Bytes inflated(chunk_bytes);
    if (libdeflate_zlib_decompress(inflate.get(), bytes.data(), bytes.size(), inflated.data(),
                                   inflated.size(), nullptr) != LIBDEFLATE_SUCCESS)
      throw damaged;
    bytes.swap(inflated);
  }
  if (bytes.size() != chunk_bytes) throw damaged;
  return bytes;
}

// The part of a chunk that lies in image `index`, row by row of the last axis.
void Hdf5Images::copy_from_chunk(const std::vector<std::uint64_t>& corner, std::uint64_t index,
                                 const Hdf5File::Bytes& chunk, Hdf5File::Bytes& image) const {
  const std::size_t last = shape_.size() - 1;
  const auto inside = [&](std::size_t k) { return std::min(chunk_[k], shape_[k] - corner[k]); };
  std::vector<std::uint64_t> at(shape_.size(), 0);  // in the chunk
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
    std::memcpy(image.data() + to * number_bytes_, chunk.data() + from * number_bytes_, row * number_bytes_);
    for (std::size_t k = last; k-- > 1;) {
      if (++at[k] < inside(k)) break;
      at[k] = 0;
    }
  }
}

}  // namespace saccade
