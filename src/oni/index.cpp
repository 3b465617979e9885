#include "oni/index.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/text.hpp"
#include "oni/bytes.hpp"
#include "oni/properties.hpp"

namespace saccade {
namespace {

// One scan, record by record.
class Scanner {
 public:
  explicit Scanner(const InputFile& file) : file_(file), walker_(file) {
    index_.header = walker_.header();
    index_.file_size = file.size();
  }

  OniIndex run() {
    while (const auto record = walker_.next()) take(*record);
    note_gaps();
    index_.lost_bytes = walker_.lost_bytes();
    index_.zero_tail_bytes = walker_.zero_tail_bytes();
    if (index_.end_position == 0)
      note(index_.file_size, OniSeverity::error, "the recording was not closed: no END record");
    for (OniNode& node : index_.nodes) node.frames.shrink_to_fit();
    return std::move(index_);
  }

 private:
  void note(std::uint64_t position, OniSeverity severity, std::string meaning) {
    index_.problems.add(position, severity, std::move(meaning));
  }

  void take(const OniRecord& record) {
    if (is_node_added(record.type)) return add_node(record);
    if (record.type == OniRecordType::end) {
      if (index_.end_position == 0) index_.end_position = record.position;
      return;
    }
    OniNode* node = find(record.node);
    if (record.type > OniRecordType::seek_table || record.type < OniRecordType::node_added_1004)
      return note(record.position, OniSeverity::warning, to_string(record.type) + " is unknown and skipped");
    if (node == nullptr)
      return note(record.position, OniSeverity::error,
                  fmt::format("{} of node {}, which was never added", to_string(record.type), record.node));
    if (is_property(record.type)) return add_property(*node, record);
    switch (record.type) {
      case OniRecordType::new_data:
        return add_frame(*node, record);
      case OniRecordType::state_ready:
        node->ready = true;
        return;
      case OniRecordType::data_begin:
        node->begun = true;
        return;
      case OniRecordType::node_removed:
        node->removed = true;
        return;
      default:
        return;
    }
  }

  OniNode* find(std::uint32_t id) {
    if (last_ < index_.nodes.size() && index_.nodes[last_].id == id) return &index_.nodes[last_];
    for (last_ = 0; last_ < index_.nodes.size(); ++last_)
      if (index_.nodes[last_].id == id) return &index_.nodes[last_];
    return nullptr;
  }

  std::span<const std::uint8_t> read_fields(const OniRecord& record, std::uint64_t limit) {
    const std::size_t header = index_.header.record_header_size();
    fields_.resize(std::min<std::uint64_t>(record.fields_size - header, limit));
    fields_.resize(file_.read(record.position + header, fields_));
    return fields_;
  }

  void add_node(const OniRecord& record) {
    const auto fields =
        parse_node_added(index_.header, record.type, read_fields(record, 4 + kOniMaxName + 64));
    if (!fields) return note(record.position, OniSeverity::error, "NODE_ADDED with damaged fields");
    if (record.node == 0 || record.node == kOniNoCount)
      return note(record.position, OniSeverity::error, fmt::format("node id {} is not allowed", record.node));
    if (find(record.node) != nullptr)
      return note(record.position, OniSeverity::error,
                  fmt::format("node {} is added twice; only the first is used", record.node));
    if (index_.nodes.size() == kOniMaxNodes)
      return note(record.position, OniSeverity::error, fmt::format("more than {} nodes", kOniMaxNodes));
    OniNode node;
    node.id = record.node;
    node.position = record.position;
    node.record_type = record.type;
    node.declared = *fields;
    index_.nodes.push_back(std::move(node));
  }

  void add_property(OniNode& node, const OniRecord& record) {
    const auto fields = read_fields(record, 8 + kOniMaxName + kOniMaxPropertySize);
    const auto property = parse_property(fields);
    if (!property)
      return note(record.position, OniSeverity::error, to_string(record.type) + " with damaged fields");
    const auto size = known_property_size(property->name);
    if (!size) return;
    if (!size->allows(property->value.size()))
      return note(record.position, OniSeverity::error,
                  fmt::format("{} has an impossible size of {}; ignored", property->name,
                              counted(property->value.size(), "byte")));
    node.changes += 1;
    node.property_bytes += property->value.size();
    if (node.changes > kOniMaxChanges || node.property_bytes > kOniMaxPropertyBytes)
      return note(record.position, OniSeverity::warning,
                  fmt::format("node {} changes its properties too often; ignored from here", node.id));
    node.properties[property->name].push_back(
        {record.position, {property->value.begin(), property->value.end()}});
  }

  void add_frame(OniNode& node, const OniRecord& record) {
    if (!holds_frames(node.declared.type)) return;
    if (index_.end_position != 0 && !after_end_noted_) {
      after_end_noted_ = true;
      note(record.position, OniSeverity::error,
           "frames after the END record, which other players do not show");
    }
    if (frames_ == kOniMaxFrames) {
      if (!full_noted_)
        note(record.position, OniSeverity::error,
             fmt::format("more than {} frames; the others are ignored", kOniMaxFrames));
      full_noted_ = true;
      return;
    }
    ++frames_;
    node.frames.push_back(
        {record.payload_position(), record.timestamp_us, record.payload_size, record.number});
  }

  void note_gaps() {
    for (const OniGap& gap : walker_.gaps()) {
      const bool last = gap.end + walker_.zero_tail_bytes() >= index_.file_size;
      note(gap.begin, OniSeverity::error,
           fmt::format("{} outside of records: {}", counted(gap.bytes(), "byte"),
                       last ? "the recording is truncated or damaged from here on"
                            : "damaged, reading resumes after them"));
    }
  }

  const InputFile& file_;
  OniWalker walker_;
  OniIndex index_;
  std::vector<std::uint8_t> fields_;
  std::size_t last_ = 0;
  std::size_t frames_ = 0;
  bool after_end_noted_ = false, full_noted_ = false;
};

}  // namespace

std::string_view to_string(OniSeverity severity) {
  switch (severity) {
    case OniSeverity::note:
      return "note";
    case OniSeverity::warning:
      return "warning";
    case OniSeverity::error:
      return "error";
  }
  return "error";
}

void OniProblems::add(std::uint64_t position, OniSeverity severity, std::string meaning) {
  ++counts_[static_cast<std::size_t>(severity)];
  if (list_.size() < kMax) list_.push_back({position, severity, std::move(meaning)});
}

void OniProblems::sort() {
  std::stable_sort(list_.begin(), list_.end(),
                   [](const OniProblem& a, const OniProblem& b) { return a.position < b.position; });
}

std::optional<std::span<const std::uint8_t>> OniNode::property(std::string_view name,
                                                               std::uint64_t before) const {
  const auto found = properties.find(name);
  if (found == properties.end()) return std::nullopt;
  const auto& all = found->second;
  const auto after = std::partition_point(all.begin(), all.end(),
                                          [&](const OniPropertyChange& c) { return c.position < before; });
  if (after == all.begin()) return std::nullopt;
  return std::span<const std::uint8_t>((after - 1)->value);
}

std::optional<std::uint64_t> OniNode::int_property(std::string_view name, std::uint64_t before) const {
  const auto value = property(name, before);
  if (!value || value->size() != 8) return std::nullopt;
  return load_le<std::uint64_t>(value->data());
}

const OniNode* OniIndex::find(std::uint32_t id) const {
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const OniNode& n) { return n.id == id; });
  return found == nodes.end() ? nullptr : &*found;
}

OniIndex scan_recording(const InputFile& file) { return Scanner(file).run(); }

}  // namespace saccade
