// Not read by libhdf5, whose version 1.10 reads beyond its buffers where a file is damaged.
#include "sources/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "sources/hdf5_tree.hpp"
#include "sources/record_cursor.hpp"

namespace saccade {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
constexpr std::uint64_t kMostHeaderBytes = 1u << 20, kMostNameBytes = 16u << 20;
constexpr int kMostNodes = 10'000, kMostBlocks = 256;

// The messages of an object's header that matter here.
constexpr std::uint16_t kContinuation = 0x10, kGroup = 0x11;

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path) : file_(path) {
  // The file begins at its start, or after a block of its user's of 512 bytes, 1024, 2048 and so on.
  std::array<std::uint8_t, kSignature.size()> signature{};
  for (base_ = 0;; base_ = base_ == 0 ? 512 : 2 * base_) {
    if (file_.read(base_, signature) != signature.size()) throw std::runtime_error("not an HDF5 file");
    if (signature == kSignature) break;
  }
  constexpr std::uint64_t kMostBytes = 8 + 16 + 4 + 4 * 8 + 2 * 8;
  const Bytes block = bytes(0, std::min(kMostBytes, file_.size() - base_));
  RecordCursor cursor(block);
  cursor.skip(kSignature.size());
  const auto version = cursor.take<std::uint8_t>();
  if (version > 1)
    throw std::runtime_error(
        "a newer form of HDF5, which is not read: write it with MATLAB, or h5py and libver='earliest'");
  cursor.skip(4);  // other versions
  const auto address_bytes = cursor.take<std::uint8_t>(), length_bytes = cursor.take<std::uint8_t>();
  if (address_bytes != 8 || length_bytes != 8)
    throw std::runtime_error("an HDF5 file whose addresses are not of 8 bytes, which is not read");
  cursor.skip(1 + 2 + 2 + 4 + (version == 1 ? 4 : 0));
  const auto base = cursor.take<std::uint64_t>();  // as it was where the file was written
  cursor.skip(8);
  const auto end = cursor.take<std::uint64_t>();
  cursor.skip(2 * 8);
  root_ = cursor.take<std::uint64_t>();
  const std::uint64_t there = file_.size() - base_;
  if (end != kNowhere && end > base && end - base > there) missing_ = end - base - there;
}

Hdf5File::Bytes Hdf5File::bytes(std::uint64_t address, std::uint64_t size) const {
  const std::uint64_t there = file_.size() - base_;
  if (address > there || size > there - address)
    throw std::runtime_error("the file is truncated or damaged: a part of it lies beyond its end");
  Bytes bytes(size);
  if (file_.read(base_ + address, bytes) != size) throw std::runtime_error("the file cannot be read");
  return bytes;
}

std::optional<std::uint64_t> Hdf5File::find(const std::string& name) const {
  const auto header = messages(root_);
  const auto group = std::ranges::find(header, kGroup, &Message::type);
  if (group == header.end())
    throw std::runtime_error(
        "its objects are listed in a newer form of HDF5, which is not read: write it with MATLAB, or h5py "
        "and libver='earliest'");
  RecordCursor cursor(group->bytes);
  const auto tree = cursor.take<std::uint64_t>(), heap = cursor.take<std::uint64_t>();

  const Bytes heap_header = bytes(heap, 32);
  cursor = RecordCursor(heap_header);
  cursor.expect("HEAP");
  cursor.skip(4);
  const auto heap_size = cursor.take<std::uint64_t>();
  cursor.skip(8);
  const Bytes names = bytes(cursor.take<std::uint64_t>(), std::min(heap_size, kMostNameBytes));
  const auto is_called = [&](std::uint64_t offset) {
    const auto* wanted = reinterpret_cast<const std::uint8_t*>(name.c_str());  // with the final NUL
    return offset < names.size() && names.size() - offset > name.size() &&
           std::equal(wanted, wanted + name.size() + 1, names.data() + offset);
  };

  // All leaves: a group has few objects. Levels fall on the way down, so that no node is its own child.
  std::vector<std::pair<std::uint64_t, int>> open = {{tree, Hdf5TreeNode::kMostLevels}};
  for (int nodes = 0; !open.empty(); ++nodes) {
    if (nodes == kMostNodes) throw std::runtime_error("a group is damaged, or has too many objects");
    const auto [address, above] = open.back();
    open.pop_back();
    if (above > 0) {
      const Hdf5TreeNode node(*this, address, 0, 8);
      if (node.level >= above) throw std::runtime_error("a group is damaged");
      for (std::size_t i = 0; i < node.count; ++i) open.emplace_back(node.child(i), node.level);
      continue;
    }
    constexpr std::uint64_t kLeafHeader = 8, kEntry = 40;
    const Bytes leaf = bytes(address, kLeafHeader);
    RecordCursor start(leaf);
    start.expect("SNOD");
    start.skip(2);
    const auto count = start.take<std::uint16_t>();
    const Bytes entries = bytes(address + kLeafHeader, count * kEntry);
    for (RecordCursor entry(entries); !entry.rest().empty(); entry.skip(kEntry - 16)) {
      const auto offset = entry.take<std::uint64_t>(), object = entry.take<std::uint64_t>();
      if (is_called(offset)) return object;
    }
  }
  return std::nullopt;
}

std::vector<Hdf5File::Message> Hdf5File::messages(std::uint64_t address) const {
  constexpr std::uint64_t kHeader = 16;
  const Bytes header = bytes(address, kHeader);
  RecordCursor start(header);
  if (start.take<std::uint8_t>() != 1)
    throw std::runtime_error("an object is damaged, or in a newer form of HDF5, which is not read");
  start.skip(7);
  std::vector<Message> messages;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks = {
      {address + kHeader, start.take<std::uint32_t>()}};
  std::uint64_t all = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto [position, size] = blocks[k];
    if (size > kMostHeaderBytes || (all += size) > kMostHeaderBytes || k == kMostBlocks)
      throw std::runtime_error("the description of an object is too long");
    const Bytes block = bytes(position, size);
    for (RecordCursor cursor(block); cursor.rest().size() >= 8;) {
      Message message{.type = cursor.take<std::uint16_t>()};
      const auto length = cursor.take<std::uint16_t>();
      message.elsewhere = (cursor.take<std::uint8_t>() & 2) != 0;
      cursor.skip(3);
      const auto content = cursor.take_bytes(length);
      message.bytes.assign(content.begin(), content.end());
      if (message.type == kContinuation) {
        RecordCursor where(message.bytes);
        const auto next = where.take<std::uint64_t>();
        blocks.emplace_back(next, where.take<std::uint64_t>());
      } else {
        messages.push_back(std::move(message));
      }
    }
  }
  return messages;
}

}  // namespace saccade
