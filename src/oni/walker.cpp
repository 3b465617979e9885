#include "oni/walker.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr std::uint64_t kLargestChunk = 65536;

}  // namespace

OniWalker::OniWalker(const InputFile& file) : file_(file) {
  std::array<std::uint8_t, kOniHeaderSize> bytes{};
  const std::size_t got = file.read(0, bytes);
  const auto header = parse_file_header(std::span(bytes).first(got));
  if (!header) throw unreadable("not an .oni recording", file.name(), "it does not begin with NI10");
  if (!is_supported(header->version))
    throw unreadable("unknown version " + to_string(header->version) + " of .oni", file.name(),
                     "versions 1.0.0.4 to 1.0.1.0 are known");
  header_ = *header;
  chunk_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kLargestChunk, file.size())));
  zero_tail_ = std::max<std::uint64_t>(find_zero_tail(), kOniHeaderSize);
}

// The position where the zeros at the end begin.
std::uint64_t OniWalker::find_zero_tail() {
  std::uint64_t end = file_.size();
  while (end > 0) {
    const std::uint64_t begin = end > chunk_.size() ? end - chunk_.size() : 0;
    const auto bytes = std::span(chunk_).first(end - begin);
    const std::size_t got = file_.read(begin, bytes);
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(got), bytes.end(), std::uint8_t{0});
    const auto last = std::find_if(bytes.rbegin(), bytes.rend(), [](std::uint8_t byte) { return byte != 0; });
    if (last != bytes.rend()) return begin + static_cast<std::uint64_t>(bytes.rend() - last);
    end = begin;
  }
  return 0;
}

std::optional<OniRecord> OniWalker::record_at(std::uint64_t position) const {
  std::array<std::uint8_t, kOniMaxRecordHeader + kOniFrameFields> bytes{};
  const std::size_t got = file_.read(position, bytes);
  const auto record = parse_record(header_, position, std::span(bytes).first(got));
  if (!record || record->fields_size > kOniMaxFields || record->payload_size > kOniMaxPayload ||
      record->end() > file_.size())
    return std::nullopt;
  return record;
}

bool OniWalker::record_or_end_at(std::uint64_t position) {
  ahead_.reset();
  // The last record may end in zeros of its own, so the tail may begin before `position`.
  if (position >= zero_tail_) return true;
  ahead_ = record_at(position);
  return ahead_.has_value();
}

std::optional<OniRecord> OniWalker::next() {
  while (position_ < zero_tail_) {
    const auto record = ahead_ ? ahead_ : record_at(position_);
    if (!record) {
      const std::uint64_t found = find_record(position_ + 1);
      add_gap(position_, found);
      position_ = found;
      continue;
    }
    const std::uint64_t end = record->end();
    if (record_or_end_at(end)) {
      position_ = end;
      return record;
    }
    // No record follows: either the length of this one is wrong, or the bytes after it are damaged.
    const std::uint64_t found = find_record(record->position + 4);
    position_ = found;
    if (found >= end) {
      add_gap(end, found);
      return record;
    }
    add_gap(record->position, found);
  }
  if (position_ > zero_tail_) zero_tail_ = std::min(position_, file_.size());
  return std::nullopt;
}

// The first position from `from` on of a record that another record or the end of the file follows; the begin
// of the zero tail if there is none. Sets ahead_ to that record.
std::uint64_t OniWalker::find_record(std::uint64_t from) {
  while (from < zero_tail_) {
    const std::size_t got = file_.read(from, chunk_);
    if (got < kOniRecordMagic.size()) break;
    const std::uint8_t* at = chunk_.data();
    const std::uint8_t* end = chunk_.data() + got;
    while ((at = static_cast<const std::uint8_t*>(::memmem(
                at, static_cast<std::size_t>(end - at), kOniRecordMagic.data(), kOniRecordMagic.size()))) !=
           nullptr) {
      const std::uint64_t position = from + static_cast<std::uint64_t>(at - chunk_.data());
      const auto candidate = record_at(position);
      if (candidate && candidate->type >= OniRecordType::node_added_1004 &&
          candidate->type <= OniRecordType::seek_table && record_or_end_at(candidate->end())) {
        ahead_ = candidate;
        return position;
      }
      ++at;
    }
    from += got - (kOniRecordMagic.size() - 1);
  }
  ahead_.reset();
  return zero_tail_;
}

void OniWalker::add_gap(std::uint64_t begin, std::uint64_t end) {
  if (begin >= end) return;
  lost_bytes_ += end - begin;
  if (!gaps_.empty() && (gaps_.back().end == begin || gaps_.size() == kMaxGaps))
    gaps_.back().end = end;
  else
    gaps_.push_back({begin, end});
}

}  // namespace saccade
