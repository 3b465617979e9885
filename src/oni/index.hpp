#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oni/format.hpp"
#include "oni/input_file.hpp"
#include "oni/walker.hpp"

namespace saccade {

/// How serious a problem of a recording is.
enum class OniSeverity {
  note,     ///< information; nothing is wrong
  warning,  ///< wrong without loss; other players may fail on it
  error,    ///< something is damaged, missing or lost
};

std::string_view to_string(OniSeverity severity);

/// One fault or peculiarity of a recording.
struct OniProblem {
  std::uint64_t position = 0;  ///< byte offset in the file
  OniSeverity severity = OniSeverity::error;
  std::string meaning;  ///< one line to show
};

/// A list of problems, of bounded length; further ones are only counted.
class OniProblems {
 public:
  static constexpr std::size_t kMax = 1000;

  void add(std::uint64_t position, OniSeverity severity, std::string meaning);
  /// Sorts them by position.
  void sort();
  const std::vector<OniProblem>& list() const { return list_; }
  /// The number of that severity, with those beyond the list.
  std::size_t count(OniSeverity severity) const { return counts_[static_cast<std::size_t>(severity)]; }

 private:
  std::vector<OniProblem> list_;
  std::size_t counts_[3] = {0, 0, 0};
};

/// The place of one frame. 24 bytes; all that the index keeps of a frame.
struct OniFrameEntry {
  std::uint64_t payload_position = 0;
  std::uint64_t timestamp_us = 0;  ///< as stored
  std::uint32_t payload_size = 0;
  std::uint32_t number = 0;  ///< as stored; may be wrong
};

struct OniPropertyChange {
  std::uint64_t position = 0;
  std::vector<std::uint8_t> value;
};

/// A stream (or device) of the recording with the places of its frames.
struct OniNode {
  std::uint32_t id = 0;
  std::uint64_t position = 0;  ///< of its NODE_ADDED record
  OniRecordType record_type = OniRecordType::node_added;
  OniNodeFields declared;
  bool ready = false, begun = false, removed = false;  ///< it has STATE_READY, DATA_BEGIN, NODE_REMOVED
  std::vector<OniFrameEntry> frames;                   ///< in file order
  /// The values of each known property (README 3), in file order.
  std::map<std::string, std::vector<OniPropertyChange>, std::less<>> properties;
  std::size_t changes = 0, property_bytes = 0;

  /// The value of a property that applies at the position `before`: that of the last record in front of it.
  std::optional<std::span<const std::uint8_t>> property(std::string_view name, std::uint64_t before) const;
  /// The same as a number; absent unless the value has 8 bytes.
  std::optional<std::uint64_t> int_property(std::string_view name, std::uint64_t before) const;
};

/// The result of one scan of a recording (README 5): its nodes, the places of their frames and their
/// properties. The scan ignores the file's own tables, counts and undo positions. Memory: 24 bytes a frame
/// (28 in a Recording whose times are not in order) and the properties, within the bounds of README 8.
struct OniIndex {
  OniFileHeader header;
  std::vector<OniNode> nodes;  ///< in file order; ids are unique
  std::uint64_t file_size = 0;
  std::uint64_t end_position = 0;     ///< of the END record; 0 = the recording was not closed
  std::uint64_t lost_bytes = 0;       ///< that are not part of a record
  std::uint64_t zero_tail_bytes = 0;  ///< zeros after the last record
  OniProblems problems;

  /// nullptr = no such node.
  const OniNode* find(std::uint32_t id) const;
};

/// Scans the file. Damage is skipped and reported in `problems`. Throws Error (unreadable) if it is no .oni
/// file or of an unknown version.
OniIndex scan_recording(const InputFile& file);

}  // namespace saccade
