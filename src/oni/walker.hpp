#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "oni/format.hpp"
#include "oni/input_file.hpp"

namespace saccade {

/// A part of the file without a usable record.
struct OniGap {
  std::uint64_t begin = 0, end = 0;
  std::uint64_t bytes() const { return end - begin; }
};

/// Returns the records of a file in order, each checked against the bounds of the format and the size of the
/// file. Where the chain of records breaks, it searches for the next record that another record or the end of
/// the file follows (README 7). It examines every byte a bounded number of times, so the time is linear in
/// the size of the file.
class OniWalker {
 public:
  /// `file` must outlive the walker. Throws Error (unreadable) if the file is no .oni file or
  /// has an unknown version.
  explicit OniWalker(const InputFile& file);

  const OniFileHeader& header() const { return header_; }

  /// The next record; absent at the end. Its end() is within the file.
  std::optional<OniRecord> next();

  /// The parts skipped so far; at most kMaxGaps, the last of which then includes all further ones.
  const std::vector<OniGap>& gaps() const { return gaps_; }
  std::uint64_t lost_bytes() const { return lost_bytes_; }

  /// The number of zero bytes after the last record; OpenNI2 leaves some, so they are no damage.
  std::uint64_t zero_tail_bytes() const { return file_.size() - zero_tail_; }

 private:
  static constexpr std::size_t kMaxGaps = 1000;

  std::optional<OniRecord> record_at(std::uint64_t position) const;
  bool record_or_end_at(std::uint64_t position);
  std::uint64_t find_record(std::uint64_t from);
  std::uint64_t find_zero_tail();
  void add_gap(std::uint64_t begin, std::uint64_t end);

  const InputFile& file_;
  OniFileHeader header_;
  std::uint64_t position_ = kOniHeaderSize;
  std::optional<OniRecord> ahead_;  // the record at position_, if it is known already
  std::uint64_t zero_tail_ = 0;     // from here to the end there are only zeros
  std::uint64_t lost_bytes_ = 0;
  std::vector<OniGap> gaps_;
  std::vector<std::uint8_t> chunk_;  // of the file, while something is searched
};

}  // namespace saccade
