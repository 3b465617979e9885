#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "oni/bytes.hpp"
#include "oni/format.hpp"
#include "oni/output_file.hpp"

namespace saccade {

/// Writes the records of an .oni file (README 9), version 1.0.1.0, so that the stock players of OpenNI2 and
/// OpenNI 1.5.4 accept them and the file is readable after every single write: nodes, properties and all that
/// a player needs before the first frame are one write; then each frame is one. Space for the closing records
/// is reserved from the start.
///
/// Order of calls: add_node() and add_property(), begin(), write_frame() and add_property(), close(). Without
/// close() the file is an unclosed recording, readable up to the last frame.
/// Thread safety: one call at a time per object.
class OniRecordWriter {
 public:
  /// Creates the file; see OutputFile.
  OniRecordWriter(const std::filesystem::path& path, bool overwrite);

  /// `id` >= 1 and not used yet. Counts and times in `fields` are ignored. Before begin() only.
  void add_node(std::uint32_t id, const OniNodeFields& fields);

  /// `type` is one of the property types. After begin() it is written with the next frame or by close().
  void add_property(std::uint32_t node, OniRecordType type, std::string_view name,
                    std::span<const std::uint8_t> value);
  void add_int(std::uint32_t node, std::string_view name, std::uint64_t value);

  /// Writes everything before the first frame and waits until it is on the disk. Throws Error (failed), also
  /// if the disk has no room.
  void begin();

  /// Appends a frame; it gets the next number of its node, from 1. False, with the file unchanged, if the
  /// disk has no room for it and the closing records. Throws Error (failed) for any other failure.
  [[nodiscard]] bool write_frame(std::uint32_t node, std::uint64_t timestamp_us,
                                 std::span<const std::uint8_t> payload);

  /// Waits until all written bytes are on the disk. Throws Error (failed).
  void flush() { file_.flush(); }
  /// As those of OutputFile.
  void flush_folder() { file_.flush_folder(); }
  void publish() { file_.publish(); }

  /// Writes tables and counts; the last call. Throws Error (failed), also if the file was deleted meanwhile;
  /// the file is then an unclosed recording.
  void close();

  const std::string& name() const { return file_.name(); }
  std::uint64_t size() const { return file_.size(); }
  std::size_t frames(std::uint32_t node) const;
  /// Removes the file.
  void remove() { file_.remove(); }

 private:
  struct Entry {
    std::uint64_t timestamp_us = 0, position = 0;
    std::uint32_t configuration = 0;
  };
  struct Node {
    std::uint32_t id = 0;
    OniNodeFields fields;
    std::uint64_t position = 0;  // of NODE_ADDED
    std::vector<Entry> entries;
    std::map<std::string, std::uint64_t, std::less<>> last_property;  // its position
  };

  Node& node(std::uint32_t id);
  std::vector<std::uint8_t> node_record(const Node& node) const;
  std::uint64_t closing_size() const;
  void add_table(Node& node);
  void put_header(OniRecordType type, std::uint32_t node, std::size_t fields_size, std::size_t payload_size,
                  std::uint64_t undo);

  OutputFile file_;
  std::vector<Node> nodes_;
  ByteBuilder pending_;              // for the next append
  std::uint32_t configuration_ = 1;  // counts properties; at least 1 in the entries of frames (README 5)
  bool begun_ = false;
};

}  // namespace saccade
