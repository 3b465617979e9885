// MCAP, the container of ROS 2 (mcap.dev/spec): records of u8 type, u64 length, content; messages are records
// of their own or within chunks.
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include <libdeflate.h>

#include "core/error.hpp"
#include "oni/bytes.hpp"
#include "sources/chunked_bag.hpp"
#include "sources/decompress.hpp"
#include "sources/record_cursor.hpp"

namespace saccade {
namespace {

constexpr std::array<std::uint8_t, 8> kMcapMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
constexpr std::uint8_t kMcapSchema = 3, kMcapChannel = 4, kMcapMessage = 5, kMcapChunk = 6, kMcapDataEnd = 15,
                       kMcapFooter = 2;
constexpr std::size_t kRecordHeader = 9, kMessageFields = 22;
constexpr std::uint64_t kLargestSmallRecord = 16u << 20;  // of schemas and channels

using Bytes = BagFile::Bytes;

std::string plain_type(std::string type) {
  if (const auto msg = type.find("/msg/"); msg != std::string::npos) type.erase(msg, 4);
  return type;
}

class McapFile final : public ChunkedBag {
 public:
  explicit McapFile(const std::filesystem::path& path) : ChunkedBag(path, kMcapMagic.size()) {
    std::array<std::uint8_t, kMcapMagic.size()> magic{};
    if (file_.read(0, magic) != magic.size() || magic != kMcapMagic)
      throw unreadable("not an MCAP file", file_.name(), "is it the right file?");
  }

 private:
  bool scan_record(std::uint64_t& position, const Visit& visit) override {
    std::array<std::uint8_t, kRecordHeader> header{};
    if (file_.read(position, header) != header.size())
      throw std::runtime_error("the file is truncated, or was not closed");
    const std::uint8_t type = header[0];
    const auto size = load_le<std::uint64_t>(&header[1]);
    const std::uint64_t content = position + kRecordHeader;
    if (type == kMcapDataEnd || type == kMcapFooter) return false;
    if (size > file_.size() - content) throw std::runtime_error("the file is truncated, or was not closed");
    if (type == kMcapSchema || type == kMcapChannel) {
      if (size > kLargestSmallRecord) throw std::runtime_error("a record is too large");
      fill(content, size, message_);
      take_definition(type, message_);
    } else if (type == kMcapMessage && size >= kMessageFields) {
      fill(content, std::min<std::uint64_t>(size, kMessageFields + kMessageBeginning), message_);
      give(message_, size, {0, content, 0}, visit);
    } else if (type == kMcapChunk) {
      scan_chunk(content, visit);
    }
    position = content + size;
    return true;
  }

  void scan_records(std::uint64_t content, Bytes chunk, const Visit& visit) override {
    std::size_t at = 0;
    while (chunk.size() - at >= kRecordHeader) {
      const std::uint8_t type = chunk[at];
      const auto size = load_le<std::uint64_t>(&chunk[at + 1]);
      at += kRecordHeader;
      if (size > chunk.size() - at) throw std::runtime_error("a record is longer than its chunk");
      const Bytes record = chunk.subspan(at, size);
      if (type == kMcapSchema || type == kMcapChannel) take_definition(type, record);
      if (type == kMcapMessage && size >= kMessageFields) give(record, size, {content, at, 0}, visit);
      at += size;
    }
  }

  void load_chunk(std::uint64_t content, std::vector<std::uint8_t>& bytes) override {
    constexpr std::size_t kMostHeader = 64;
    constexpr std::uint64_t kMostCompressed = 512u << 20;
    std::array<std::uint8_t, kMostHeader> header{};
    RecordCursor cursor(std::span<const std::uint8_t>(header).first(file_.read(content, header)));
    cursor.skip(2 * sizeof(std::uint64_t));  // first and last time
    const auto size = cursor.take<std::uint64_t>();
    const auto checksum = cursor.take<std::uint32_t>();
    const std::string method = cursor.take_text();
    const auto compressed = cursor.take<std::uint64_t>();
    const std::uint64_t begin = content + kMostHeader - cursor.rest().size();
    if (compressed > kMostCompressed || begin > file_.size() || compressed > file_.size() - begin)
      throw std::runtime_error("it is longer than the file");
    fill(begin, compressed, compressed_);
    decompress(method, compressed_, size, bytes);
    if (checksum != 0 && libdeflate_crc32(0, bytes.data(), bytes.size()) != checksum)
      throw std::runtime_error("its checksum does not fit");
  }

  void take_definition(std::uint8_t type, Bytes record) {
    RecordCursor cursor(record);
    const auto id = cursor.take<std::uint16_t>();
    if (type == kMcapSchema) {
      schemas_[id] = cursor.take_text();
      return;
    }
    if (channels_.contains(id)) return;  // repeated in each chunk
    const auto schema = cursor.take<std::uint16_t>();
    BagTopic topic;
    topic.name = cursor.take_text();
    topic.encoding = cursor.take_text() == "ros1" ? BagEncoding::ros1 : BagEncoding::cdr;
    topic.type = plain_type(schemas_[schema]);
    channels_[id] = topics_.size();
    topics_.push_back(std::move(topic));
  }

  // `record`: the message record or its beginning; `size`: of the whole record.
  void give(Bytes record, std::uint64_t size, BagPlace place, const Visit& visit) {
    const auto channel = channels_.find(load_le<std::uint16_t>(record.data()));
    if (channel == channels_.end() || size - kMessageFields > kLargestMessage) return;
    if (!topics_[channel->second].type.starts_with("sensor_msgs/")) return;
    place.offset += kMessageFields;
    place.size = static_cast<std::uint32_t>(size - kMessageFields);
    visit(channel->second, load_le<std::int64_t>(&record[6]), record.subspan(kMessageFields), place);
  }

  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::size_t> channels_;  // number in topics_
  std::vector<std::uint8_t> compressed_;
};

}  // namespace

std::unique_ptr<BagFile> open_mcap(const std::filesystem::path& path) {
  return std::make_unique<McapFile>(path);
}

}  // namespace saccade
