#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace saccade {

/// What a repair kept and omitted.
struct OniRepairReport {
  std::uint64_t frames = 0;        ///< in the new file
  std::uint64_t bad_frames = 0;    ///< that did not decode, and were omitted
  std::uint64_t lost_bytes = 0;    ///< of the original that are not part of a record
  std::vector<std::string> notes;  ///< streams omitted, properties added; one line each
};

/// Writes a new, sound recording (README 10) of every good frame of `from`. It omits damaged parts, bad
/// frames and streams that no player can decode, adds the properties that the stock players need, and writes
/// new tables and counts. Payloads are copied, so no pixel changes. The new file has version 1.0.1.0. The
/// original is never changed. Throws Error: `from` is no recording, has no usable stream or no good frame
/// (unreadable); `to` exists and `overwrite` is false, or is the same file (usage); the disk is full
/// (failed). After an error `to` is as it was before.
OniRepairReport repair_recording(const std::filesystem::path& from, const std::filesystem::path& to,
                                 bool overwrite);

/// A piece of a recording: frames of its first depth stream by their numbers, from 0, or by their times from
/// the first of them. Both ends are in it.
struct OniPiece {
  std::uint64_t first = 0, last = 0;  ///< numbers, or us
  bool times = false;                 ///< they are times
};

/// Reads "FROM..TO": frame numbers ("10..20") or seconds ("1.5s..3s"). Throws std::invalid_argument that says
/// what is expected.
OniPiece parse_piece(std::string_view text);

/// Like repair_recording(), with the frames of `piece` and those of other streams that belong to them in
/// time. Frames keep their times. Throws Error (usage) also if the recording has no frame in the piece.
OniRepairReport cut_recording(const std::filesystem::path& from, const std::filesystem::path& to,
                              const OniPiece& piece, bool overwrite);

}  // namespace saccade
