#include "oni/record_writer.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr std::size_t kHeader = kOniMaxRecordHeader;
constexpr std::size_t kTableEntry = 20;
constexpr const char* kFullHint = "free some space and try again";

void put_file_header(ByteBuilder& out, std::uint64_t max_timestamp, std::uint32_t max_node_id) {
  out.put(kOniFileMagic);
  out.put(std::uint8_t{1});
  out.put(std::uint8_t{0});
  out.put(std::uint16_t{1});
  out.put(std::uint32_t{0});
  out.put(max_timestamp);
  out.put(max_node_id);
}

void put_record_header(ByteBuilder& out, OniRecordType type, std::uint32_t node, std::size_t fields_size,
                       std::size_t payload_size, std::uint64_t undo) {
  out.put(kOniRecordMagic);
  out.put(static_cast<std::uint32_t>(type));
  out.put(node);
  out.put(static_cast<std::uint32_t>(kHeader + fields_size));
  out.put(static_cast<std::uint32_t>(payload_size));
  out.put(undo);
}

}  // namespace

OniRecordWriter::OniRecordWriter(const std::filesystem::path& path, bool overwrite) : file_(path, overwrite) {
  put_file_header(pending_, kOniNoTime, 0);  // begin() sets the largest node id
}

OniRecordWriter::Node& OniRecordWriter::node(std::uint32_t id) {
  const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& n) { return n.id == id; });
  if (found == nodes_.end()) throw std::invalid_argument("OniRecordWriter: no such node");
  return *found;
}

std::size_t OniRecordWriter::frames(std::uint32_t id) const {
  const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& n) { return n.id == id; });
  return found == nodes_.end() ? 0 : found->entries.size();
}

void OniRecordWriter::put_header(OniRecordType type, std::uint32_t node, std::size_t fields_size,
                                 std::size_t payload_size, std::uint64_t undo) {
  put_record_header(pending_, type, node, fields_size, payload_size, undo);
}

// NODE_ADDED has the same size whenever it is written.
std::vector<std::uint8_t> OniRecordWriter::node_record(const Node& node) const {
  ByteBuilder fields;
  fields.put_string(node.fields.name);
  fields.put(static_cast<std::int32_t>(node.fields.type));
  fields.put(static_cast<std::uint32_t>(node.fields.codec));
  fields.put(node.fields.frames);
  fields.put(node.fields.min_timestamp_us);
  fields.put(node.fields.max_timestamp_us);
  fields.put(node.fields.table_position);
  ByteBuilder record;
  put_record_header(record, OniRecordType::node_added, node.id, fields.size(), 0, 0);
  record.put_bytes(fields.bytes());
  return record.take();
}

void OniRecordWriter::add_node(std::uint32_t id, const OniNodeFields& fields) {
  const bool used = std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& n) { return n.id == id; });
  if (begun_ || used || id == 0 || id == kOniNoCount)
    throw std::invalid_argument("OniRecordWriter: a new node id is needed, before begin()");
  Node added;
  added.id = id;
  added.fields = fields;
  added.fields.frames = kOniNoCount;
  added.fields.min_timestamp_us = 0;
  added.fields.max_timestamp_us = kOniNoTime;
  added.fields.table_position = 0;
  added.position = file_.size() + pending_.size();
  pending_.put_bytes(node_record(added));
  nodes_.push_back(std::move(added));
}

void OniRecordWriter::add_property(std::uint32_t id, OniRecordType type, std::string_view name,
                                   std::span<const std::uint8_t> value) {
  if (!is_property(type)) throw std::invalid_argument("OniRecordWriter: not a property");
  Node& owner = node(id);
  ByteBuilder fields;
  fields.put_string(name);
  fields.put(static_cast<std::uint32_t>(value.size()));
  fields.put_bytes(value);
  auto last = owner.last_property.find(name);
  if (last == owner.last_property.end()) last = owner.last_property.emplace(std::string(name), 0).first;
  const std::uint64_t position = file_.size() + pending_.size();
  put_header(type, id, fields.size(), 0, last->second);
  pending_.put_bytes(fields.bytes());
  last->second = position;
  ++configuration_;
}

void OniRecordWriter::add_int(std::uint32_t id, std::string_view name, std::uint64_t value) {
  std::uint8_t bytes[8];
  store_le(bytes, value);
  add_property(id, OniRecordType::int_property, name, bytes);
}

void OniRecordWriter::begin() {
  std::uint32_t largest = 0;
  for (const Node& each : nodes_) {
    largest = std::max(largest, each.id);
    put_header(OniRecordType::state_ready, each.id, 0, 0, 0);
    put_header(OniRecordType::data_begin, each.id, 12, 0, 0);
    pending_.put(kOniNoCount);
    pending_.put(kOniNoTime);
  }
  std::vector<std::uint8_t> block = pending_.take();
  store_le(block.data() + 20, largest);
  if (!file_.reserve(block.size() + closing_size()) || !file_.append(block))
    throw failed("disk full", file_.name(), kFullHint);
  file_.flush();
  pending_.clear();
  begun_ = true;
}

// The size of all that close() appends, with one more frame for each node.
std::uint64_t OniRecordWriter::closing_size() const {
  std::uint64_t size = kHeader + 1024;  // END, and some properties before it
  for (const Node& each : nodes_) size += 2 * kHeader + (each.entries.size() + 2) * kTableEntry;
  return size;
}

bool OniRecordWriter::write_frame(std::uint32_t id, std::uint64_t timestamp_us,
                                  std::span<const std::uint8_t> payload) {
  if (!begun_ || payload.size() > kOniMaxPayload)
    throw std::invalid_argument("OniRecordWriter: a frame before begin(), or too large");
  Node& owner = node(id);
  const std::size_t properties = pending_.size();
  const std::uint64_t position = file_.size() + properties;
  put_header(OniRecordType::new_data, id, kOniFrameFields, payload.size(),
             owner.entries.empty() ? 0 : owner.entries.back().position);
  pending_.put(timestamp_us);
  pending_.put(static_cast<std::uint32_t>(owner.entries.size() + 1));
  pending_.put_bytes(payload);
  if (!file_.reserve(pending_.size() + closing_size()) || !file_.append(pending_.bytes())) {
    pending_.cut(properties);
    return false;
  }
  pending_.clear();
  owner.entries.push_back({timestamp_us, position, configuration_});
  return true;
}

// NODE_REMOVED and SEEK_TABLE; a node without frames has no table.
void OniRecordWriter::add_table(Node& node) {
  put_header(OniRecordType::node_removed, node.id, 0, 0, node.position);
  node.fields.frames = static_cast<std::uint32_t>(node.entries.size());
  node.fields.max_timestamp_us = 0;
  if (node.entries.empty()) return;
  node.fields.table_position = file_.size() + pending_.size();
  put_header(OniRecordType::seek_table, node.id, 0, (node.entries.size() + 1) * kTableEntry, 0);
  node.fields.min_timestamp_us = kOniNoTime;
  for (std::size_t i = 0; i < kTableEntry; ++i) pending_.put(std::uint8_t{0});  // entry 0 is empty
  for (const Entry& entry : node.entries) {
    pending_.put(entry.timestamp_us);
    pending_.put(entry.configuration);
    pending_.put(entry.position);
    node.fields.min_timestamp_us = std::min(node.fields.min_timestamp_us, entry.timestamp_us);
    node.fields.max_timestamp_us = std::max(node.fields.max_timestamp_us, entry.timestamp_us);
  }
}

void OniRecordWriter::close() {
  for (Node& each : nodes_) add_table(each);
  put_header(OniRecordType::end, 0, 0, 0, 0);
  if (!file_.append(pending_.bytes())) throw failed("disk full while closing", file_.name(), kFullHint);
  pending_.clear();
  file_.flush();
  ByteBuilder header;
  std::uint64_t last = 0;
  std::uint32_t largest = 0;
  for (const Node& each : nodes_) {
    file_.overwrite(each.position, node_record(each));
    last = std::max(last, each.fields.max_timestamp_us);
    largest = std::max(largest, each.id);
  }
  put_file_header(header, last, largest);
  file_.overwrite(0, header.bytes());
  file_.release_reserve();
  file_.flush();
  file_.check_in_place();
  file_.publish();
}

}  // namespace saccade
