#include "sources/matroska_checksums.hpp"

#include <algorithm>
#include <bit>

namespace saccade {
namespace {

constexpr std::uint32_t kEbml = 0x1A45DFA3, kSegment = 0x18538067, kCluster = 0x1F43B675, kCrc = 0xBF;
constexpr std::int64_t kUnknownSize = -1;

constexpr std::array<std::uint32_t, 256> kTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320U : 0U);
    table[i] = value;
  }
  return table;
}();

}  // namespace

MatroskaChecksums::MatroskaChecksums(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) return;
  size_ = static_cast<std::int64_t>(size);
  next_ = size_;
  const auto header = element_at(0);
  if (!header || header->id != kEbml || header->size == kUnknownSize || header->end() > size_) return;
  const auto segment = element_at(header->end());
  if (!segment || segment->id != kSegment) return;
  next_ = segment->content;
  next_cluster();
}

bool MatroskaChecksums::damaged_at(std::int64_t position) {
  while (position >= cluster_.end())
    if (!next_cluster()) return present_;
  return position < cluster_.content ? present_ : damaged_;
}

// Goes to the next complete cluster and checks it; false if there is none. A cluster that the end of the file
// cuts has lost images, which are noticed when they are read.
bool MatroskaChecksums::next_cluster() {
  while (next_ < size_) {
    const auto element = element_at(next_);
    if (!element || element->size == kUnknownSize || element->size > size_ - element->content) break;
    next_ = element->end();
    if (element->id != kCluster) continue;
    const bool first = cluster_.end() == 0;
    cluster_ = *element;
    std::int64_t begin = 0;
    const auto stored = checksum_of(cluster_, begin);
    if (first) present_ = stored.has_value();
    damaged_ = stored ? compute(begin, cluster_.end()) != *stored : present_;
    if (damaged_) ++damaged_clusters_;
    return true;
  }
  next_ = size_;
  return false;
}

// The checksum at the start of a cluster; `begin`: of the bytes that it covers, up to the cluster's end.
std::optional<std::uint32_t> MatroskaChecksums::checksum_of(const Element& cluster, std::int64_t& begin) {
  const auto first = element_at(cluster.content);
  if (!first || first->id != kCrc || first->size != 4 || first->end() > cluster.end()) return std::nullopt;
  std::array<std::uint8_t, 4> bytes{};
  if (read(first->content, bytes) != bytes.size()) return std::nullopt;
  begin = first->end();
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

std::uint32_t MatroskaChecksums::compute(std::int64_t begin, std::int64_t end) {
  std::array<std::uint8_t, 1 << 16> bytes{};
  std::uint32_t crc = 0xffffffff;
  while (begin < end) {
    const auto wanted = std::min(end - begin, static_cast<std::int64_t>(bytes.size()));
    const std::size_t got = read(begin, std::span(bytes).first(static_cast<std::size_t>(wanted)));
    if (got == 0) break;
    for (std::size_t i = 0; i < got; ++i) crc = (crc >> 8) ^ kTable[(crc ^ bytes[i]) & 0xff];
    begin += static_cast<std::int64_t>(got);
  }
  return ~crc;
}

// The element of EBML whose header is at `position`; std::nullopt if there is none.
std::optional<MatroskaChecksums::Element> MatroskaChecksums::element_at(std::int64_t position) {
  std::array<std::uint8_t, 12> bytes{};
  const std::size_t got = read(position, bytes);
  if (got < 2 || bytes[0] < 0x10) return std::nullopt;  // an id has 1 to 4 bytes
  Element element;
  const auto id_bytes = static_cast<std::size_t>(std::countl_zero(bytes[0]) + 1);
  for (std::size_t i = 0; i < id_bytes; ++i) element.id = element.id << 8 | bytes[i];
  const std::uint8_t first = bytes[id_bytes];
  const auto size_bytes = static_cast<std::size_t>(std::countl_zero(first) + 1);
  if (size_bytes > 8 || got < id_bytes + size_bytes) return std::nullopt;
  const unsigned most = 0xffU >> size_bytes;
  std::uint64_t size = first & most;
  bool unknown = size == most;
  for (std::size_t i = 1; i < size_bytes; ++i) {
    size = size << 8 | bytes[id_bytes + i];
    unknown = unknown && bytes[id_bytes + i] == 0xff;
  }
  element.content = position + static_cast<std::int64_t>(id_bytes + size_bytes);
  element.size = unknown ? kUnknownSize : static_cast<std::int64_t>(size);
  return element;
}

std::size_t MatroskaChecksums::read(std::int64_t position, std::span<std::uint8_t> bytes) {
  file_.clear();
  file_.seekg(position);
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return static_cast<std::size_t>(std::max<std::streamsize>(0, file_.gcount()));
}

}  // namespace saccade
