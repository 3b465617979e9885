#include "oni/check.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "core/text.hpp"
#include "oni/bytes.hpp"
#include "oni/walker.hpp"

namespace saccade {
namespace {

class Checker {
 public:
  explicit Checker(Recording& recording) : recording_(recording), index_(recording.index()) {
    problems_ = index_.problems;
  }

  OniProblems run() {
    check_file();
    for (const OniNode& node : index_.nodes) {
      check_node(node);
      if (holds_frames(node.declared.type)) check_frames(node);
    }
    check_links();
    problems_.sort();
    return problems_;
  }

 private:
  bool closed() const { return index_.end_position != 0; }

  void add(std::uint64_t position, OniSeverity severity, std::string meaning) {
    problems_.add(position, severity, std::move(meaning));
  }

  void check_file() {
    if (index_.zero_tail_bytes > 0)
      add(index_.file_size - index_.zero_tail_bytes, OniSeverity::note,
          fmt::format("{} at the end, as OpenNI2 leaves them", counted(index_.zero_tail_bytes, "zero byte")));
    if (index_.nodes.empty()) add(kOniHeaderSize, OniSeverity::error, "no streams");
    if (!closed()) return;
    std::uint64_t last_us = 0;
    std::uint32_t largest_id = 0;
    for (const OniNode& node : index_.nodes) {
      largest_id = std::max(largest_id, node.id);
      for (const OniFrameEntry& frame : node.frames) last_us = std::max(last_us, frame.timestamp_us);
    }
    if (index_.header.max_timestamp < last_us)
      add(12, OniSeverity::error, "the header's largest time is before the last frame; players stop there");
    if (index_.header.max_node_id < largest_id || index_.header.max_node_id == kOniNoCount)
      add(20, OniSeverity::error, "the header's largest node id is wrong; players refuse the file");
  }

  void check_node(const OniNode& node) {
    if (!node.ready)
      add(node.position, OniSeverity::error,
          fmt::format("node {} has no STATE_READY; players crash", node.id));
    if (!holds_frames(node.declared.type)) return;
    const bool empty = node.frames.empty();
    if (empty) {
      add(node.position, OniSeverity::note, fmt::format("node {} has no frames", node.id));
    } else if (!node.begun) {
      add(node.position, OniSeverity::error,
          fmt::format("node {} has no DATA_BEGIN; players refuse", node.id));
    }
    const std::uint64_t begin = empty ? index_.file_size : node.frames.front().payload_position;
    if (!node.property(oni_property::kCropping, begin))
      add(node.position, OniSeverity::error,
          fmt::format("node {} has no xnCropping; OpenNI2 shows none of its frames", node.id));
    const bool counts = node.record_type != OniRecordType::node_added_1004;
    if (closed() && counts && node.declared.frames != node.frames.size())
      add(node.position, OniSeverity::error,
          fmt::format("node {} declares {} and has {}", node.id, counted(node.declared.frames, "frame"),
                      node.frames.size()));
  }

  void check_frames(const OniNode& node) {
    cv::Mat1w depth;
    cv::Mat3b colour;
    for (std::size_t k = 0; k < node.frames.size(); ++k) {
      const OniFrameEntry& frame = node.frames[k];
      const Outcome read = node.declared.type == OniNodeType::depth
                               ? recording_.read_stored_depth(node, k, depth)
                               : recording_.read_colour(node, k, colour);
      if (!read) {
        // A camera's own JPEG is stored as it arrived: damage in it is not damage of the recording.
        const bool from_camera = recording_.format(node, k).pixels == OniPixelFormat::jpeg;
        add(frame.payload_position, from_camera ? OniSeverity::warning : OniSeverity::error,
            fmt::format("frame {} of node {}: {}", k, node.id, read.reason()));
      }
      if (frame.number != k + 1 && !numbers_noted_) {
        numbers_noted_ = true;
        add(frame.payload_position, OniSeverity::warning,
            fmt::format("frame {} of node {} carries the number {}", k, node.id, frame.number));
      }
      if (k > 0 && frame.timestamp_us < node.frames[k - 1].timestamp_us)
        add(frame.payload_position, OniSeverity::warning,
            fmt::format("frame {} of node {} is earlier than the one before", k, node.id));
    }
  }

  // Undo positions and seek tables.
  void check_links() {
    OniWalker walker(recording_.file());
    while (const auto record = walker.next()) {
      const OniNode* node = index_.find(record->node);
      if (node == nullptr) continue;
      if (record->type == OniRecordType::new_data) {
        check_undo(*record, last_frame_[record->node]);
        last_frame_[record->node] = record->position;
      } else if (record->type == OniRecordType::node_removed) {
        check_undo(*record, node->position);
      } else if (record->type == OniRecordType::seek_table &&
                 record->position == node->declared.table_position) {
        tables_found_[record->node] = true;
        check_table(*node, *record);
      }
    }
    for (const OniNode& node : index_.nodes)
      if (node.declared.table_position != 0 && !tables_found_[node.id])
        add(node.position, OniSeverity::error,
            fmt::format("node {} declares its table at {}, where there is none; players refuse", node.id,
                        node.declared.table_position));
  }

  void check_undo(const OniRecord& record, std::uint64_t expected) {
    if (record.undo != expected)
      add(record.position, OniSeverity::warning,
          fmt::format("{} points back to {} instead of {}", to_string(record.type), record.undo, expected));
  }

  void check_table(const OniNode& node, const OniRecord& record) {
    const std::size_t entry_size = index_.header.table_entry_size();
    const std::size_t expected = (node.frames.size() + 1) * entry_size;
    if (record.payload_size != expected)
      return add(record.position, OniSeverity::error,
                 fmt::format("the table of node {} has {} instead of {}; players refuse", node.id,
                             counted(record.payload_size, "byte"), expected));
    std::array<std::uint8_t, 20> entry{};
    for (std::size_t k = 0; k < node.frames.size(); ++k) {
      const std::uint64_t at = record.payload_position() + (k + 1) * entry_size;
      if (recording_.file().read(at, std::span(entry).first(entry_size)) != entry_size) return;
      const auto time = load_le<std::uint64_t>(&entry[0]);
      const std::uint64_t position =
          index_.header.narrow() ? load_le<std::uint32_t>(&entry[12]) : load_le<std::uint64_t>(&entry[12]);
      const OniFrameEntry& frame = node.frames[k];
      const bool there = position < index_.file_size && is_frame_at(position, frame);
      if (time != frame.timestamp_us || !there)
        return add(at, OniSeverity::error,
                   fmt::format("the table of node {} is wrong from frame {} on; players seek to wrong frames",
                               node.id, k));
    }
  }

  bool is_frame_at(std::uint64_t position, const OniFrameEntry& frame) const {
    std::array<std::uint8_t, kOniMaxRecordHeader + kOniFrameFields> bytes{};
    const std::size_t got = recording_.file().read(position, bytes);
    const auto record = parse_record(index_.header, position, std::span(bytes).first(got));
    return record && record->type == OniRecordType::new_data &&
           record->payload_position() == frame.payload_position;
  }

  Recording& recording_;
  const OniIndex& index_;
  OniProblems problems_;
  std::map<std::uint32_t, std::uint64_t> last_frame_;
  std::map<std::uint32_t, bool> tables_found_;
  bool numbers_noted_ = false;
};

}  // namespace

OniProblems check_recording(Recording& recording) { return Checker(recording).run(); }

}  // namespace saccade
