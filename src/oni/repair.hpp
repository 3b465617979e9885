#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace saccade {

/// What a repair kept and left out.
struct OniRepairReport {
  std::uint64_t frames = 0;        ///< in the new file
  std::uint64_t bad_frames = 0;    ///< that did not decode, and were left out
  std::uint64_t lost_bytes = 0;    ///< of the old file, that were no records
  std::vector<std::string> notes;  ///< streams left out, properties added; one line each
};

/// Makes a new, sound file of every good frame of `from`: damaged parts, bad frames and streams that nobody
/// can play are left out, what the stock players need is added, and tables and counts are written anew.
/// Payloads are copied as they are, so no pixel changes. Old versions of the format become the present one.
/// The original is never written to. Throws Error: `from` is no recording or has no usable stream
/// (unreadable); `to` exists and is not to be overwritten, or is the same file (usage); the disk is full
/// (failed, and `to` is removed).
OniRepairReport repair_recording(const std::filesystem::path& from, const std::filesystem::path& to,
                                 bool overwrite);

}  // namespace saccade
