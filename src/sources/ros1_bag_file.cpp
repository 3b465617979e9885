// The .bag of ROS 1, version 2.0: records of u32 length, header, u32 length, data; a header is fields of u32
// length and "name=value". Messages are in chunks, or at the top in files of old recorders.
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "oni/bytes.hpp"
#include "sources/chunked_bag.hpp"
#include "sources/decompress.hpp"

namespace saccade {
namespace {

using Bytes = BagFile::Bytes;

constexpr std::string_view kRos1Magic = "#ROSBAG V2.0\n";
constexpr std::uint8_t kRos1Message = 2, kRos1Chunk = 5, kRos1Connection = 7;
constexpr std::uint32_t kLargestHeader = 1u << 20;
constexpr std::uint32_t kLargestData = 512u << 20;

// The fields of a header, without copies.
class Fields {
 public:
  explicit Fields(Bytes header) : cursor_(header) {}

  Bytes find(std::string_view name) const {
    ByteCursor cursor = cursor_;
    while (!cursor.rest().empty()) {
      const auto size = cursor.take<std::uint32_t>();
      const auto field = size ? cursor.take_bytes(*size) : std::nullopt;
      if (!field) throw std::runtime_error("a header is too short");
      const std::string_view text(reinterpret_cast<const char*>(field->data()), field->size());
      if (text.size() > name.size() && text.starts_with(name) && text[name.size()] == '=')
        return field->subspan(name.size() + 1);
    }
    return {};
  }

  template <typename T>
  T number(std::string_view name) const {
    const Bytes value = find(name);
    if (value.size() != sizeof(T)) throw std::runtime_error(fmt::format("a header has no {}", name));
    return load_le<T>(value.data());
  }

  std::string text(std::string_view name) const {
    const Bytes value = find(name);
    return {value.begin(), value.end()};
  }

 private:
  ByteCursor cursor_;
};

class Ros1BagFile final : public ChunkedBag {
 public:
  explicit Ros1BagFile(const std::filesystem::path& path) : ChunkedBag(path, kRos1Magic.size()) {
    std::array<std::uint8_t, kRos1Magic.size()> magic{};
    if (file_.read(0, magic) != magic.size() || !std::ranges::equal(magic, kRos1Magic))
      throw unreadable("not a ROS bag of version 2.0", file_.name(), "is it the right file?");
  }

 private:
  struct Record {
    std::vector<std::uint8_t> header;
    std::uint64_t data = 0;  // position
    std::uint32_t size = 0;  // bytes of data
  };

  std::uint32_t length_at(std::uint64_t position) const {
    std::array<std::uint8_t, 4> bytes{};
    if (file_.read(position, bytes) != bytes.size()) throw std::runtime_error("the file is truncated");
    return load_le<std::uint32_t>(bytes.data());
  }

  Record record_at(std::uint64_t position) const {
    Record record;
    const std::uint32_t header = length_at(position);
    if (header > kLargestHeader) throw std::runtime_error("a header is too long");
    record.header.resize(header);
    if (file_.read(position + 4, record.header) != header) throw std::runtime_error("the file is truncated");
    record.size = length_at(position + 4 + header);
    record.data = position + 8 + header;
    if (record.size > file_.size() - record.data) throw std::runtime_error("the file is truncated");
    return record;
  }

  bool scan_record(std::uint64_t& position, const Visit& visit) override {
    if (position >= file_.size()) return false;
    const Record record = record_at(position);
    const Fields fields(record.header);
    switch (fields.number<std::uint8_t>("op")) {
      case kRos1Chunk:
        scan_chunk(position, visit);
        break;
      case kRos1Connection:
        fill(record.data, std::min(record.size, kLargestHeader), message_);
        take_connection(fields, message_);
        break;
      case kRos1Message:
        fill(record.data, std::min(record.size, kMessageBeginning), message_);
        give(fields, message_, {0, record.data, record.size}, visit);
        break;
      default:
        break;  // the file's header and its indices
    }
    position = record.data + record.size;
    return true;
  }

  void scan_records(std::uint64_t position, Bytes chunk, const Visit& visit) override {
    ByteCursor cursor(chunk);
    const auto take = [&] {
      const auto size = cursor.take<std::uint32_t>();
      const auto bytes = size ? cursor.take_bytes(*size) : std::nullopt;
      if (!bytes) throw std::runtime_error("a record is longer than its chunk");
      return *bytes;
    };
    while (!cursor.rest().empty()) {
      const Bytes header = take(), data = take();
      const Fields fields(header);
      const auto op = fields.number<std::uint8_t>("op");
      if (op == kRos1Connection) take_connection(fields, data);
      const auto offset = static_cast<std::uint64_t>(data.data() - chunk.data());
      const auto size = static_cast<std::uint32_t>(data.size());
      if (op == kRos1Message) give(fields, data, {position, offset, size}, visit);
    }
  }

  void load_chunk(std::uint64_t position, std::vector<std::uint8_t>& bytes) override {
    const Record record = record_at(position);
    const Fields fields(record.header);
    if (record.size > kLargestData) throw std::runtime_error("it is too large");
    fill(record.data, record.size, compressed_);
    decompress(fields.text("compression"), compressed_, fields.number<std::uint32_t>("size"), bytes);
  }

  void take_connection(const Fields& fields, Bytes data) {
    const auto id = fields.number<std::uint32_t>("conn");
    if (connections_.contains(id)) return;
    BagTopic topic;
    topic.name = fields.text("topic");
    topic.type = Fields(data).text("type");
    // A topic has a connection for each of its publishers.
    const auto same = std::ranges::find_if(
        topics_, [&](const BagTopic& t) { return t.name == topic.name && t.type == topic.type; });
    connections_[id] = static_cast<std::size_t>(same - topics_.begin());
    if (same == topics_.end()) topics_.push_back(std::move(topic));
  }

  void give(const Fields& fields, Bytes data, const BagPlace& place, const Visit& visit) {
    const auto connection = connections_.find(fields.number<std::uint32_t>("conn"));
    if (connection == connections_.end() || place.size > kLargestMessage) return;
    if (!topics_[connection->second].type.starts_with("sensor_msgs/")) return;
    const auto time = fields.number<std::uint64_t>("time");  // seconds, and ns above them
    const auto time_ns = static_cast<std::int64_t>((time & 0xFFFFFFFFu) * 1'000'000'000u + (time >> 32));
    visit(connection->second, time_ns, data, place);
  }

  std::map<std::uint32_t, std::size_t> connections_;  // number in topics_
  std::vector<std::uint8_t> compressed_;
};

}  // namespace

std::unique_ptr<BagFile> open_ros1_bag(const std::filesystem::path& path) {
  return std::make_unique<Ros1BagFile>(path);
}

}  // namespace saccade
