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

/// Writes the records of an .oni file (version 1.0.1.0) in an order and with contents that the stock players
/// of OpenNI2 and OpenNI 1.5.4 accept, and so that the file is whole after every single write: nodes, their
/// properties and what a player needs before the first frame go out as one block; then each frame is one
/// append. Room for the closing records is kept on the disk from the start.
///
/// First add_node() and add_property(), then begin(), then write_frame() and add_property(), then close().
/// Without close() the file is one of an interrupted recording: readable up to the last frame.
/// Thread safety: one call at a time per object.
class OniRecordWriter {
 public:
  /// Creates the file; see OutputFile.
  OniRecordWriter(const std::filesystem::path& path, bool overwrite);

  /// `id` >= 1 and not used yet. Counts and times in `fields` are ignored. Before begin() only.
  void add_node(std::uint32_t id, const OniNodeFields& fields);

  /// `type` is one of the property types. After begin() it goes out with the next frame, or with close().
  void add_property(std::uint32_t node, OniRecordType type, std::string_view name,
                    std::span<const std::uint8_t> value);
  void add_int(std::uint32_t node, std::string_view name, std::uint64_t value);

  /// Writes everything up to the first frame and waits until it is on the disk. Throws Error (failed), also
  /// where the disk has no room.
  void begin();

  /// Appends a frame; its number is its place in the node, from 1. False, with the file unchanged, if the
  /// disk has no room for it and the closing records. Throws Error (failed) if writing fails otherwise.
  [[nodiscard]] bool write_frame(std::uint32_t node, std::uint64_t timestamp_us,
                                 std::span<const std::uint8_t> payload);

  /// Waits until all that is written is on the disk. Throws Error (failed).
  void flush() { file_.flush(); }
  /// Waits until the file's entry in its folder is on the disk; see OutputFile.
  void flush_folder() { file_.flush_folder(); }

  /// Writes tables and counts. Nothing may follow. Throws Error (failed); the file is then readable as an
  /// interrupted one.
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
  ByteBuilder pending_;              // what the next append writes
  std::uint32_t configuration_ = 1;  // raised with every property; the table's real entries carry at least 1
  bool begun_ = false;
};

}  // namespace saccade
