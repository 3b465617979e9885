#include "sources/numbered_frames.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace saccade {
namespace fs = std::filesystem;
namespace {

// "4 frames are missing in the numbering: 3, 7..9"; std::nullopt if none is.
std::optional<std::string> describe_gaps(const std::map<std::int64_t, FolderEntry>& found) {
  constexpr std::size_t kShown = 8;
  std::vector<std::string> gaps;
  std::size_t count = 0;
  std::int64_t missing = 0, previous = found.begin()->first;
  for (const auto& [number, entry] : found) {
    const std::int64_t gap = number - previous - 1;
    if (gap > 0) {
      missing += gap;
      if (count++ < kShown)
        gaps.push_back(gap == 1 ? fmt::format("{}", number - 1)
                                : fmt::format("{}..{}", previous + 1, number - 1));
    }
    previous = number;
  }
  if (count == 0) return std::nullopt;
  return fmt::format("{} frame{} missing in the numbering: {}{}", missing, missing == 1 ? " is" : "s are",
                     fmt::join(gaps, ", "), count > kShown ? ", ..." : "");
}

}  // namespace

FolderNames::FolderNames(const fs::path& folder) : folder_(folder) {
  for (const auto& file : fs::directory_iterator(folder.empty() ? fs::path(".") : folder))
    names_.insert(file.path().filename().string());
}

fs::path FolderNames::first_of(std::initializer_list<std::string> names) const {
  for (const std::string& name : names)
    if (names_.contains(name)) return folder_ / name;
  return {};
}

FolderListing list_by_number(std::map<std::int64_t, FolderEntry> frames) {
  constexpr double kLatest_us = 9e18;  // numbers can be as large as integers are
  FolderListing listing;
  if (frames.empty()) return listing;
  if (const auto gaps = describe_gaps(frames)) listing.notes.push_back(*gaps);
  const std::int64_t first = frames.begin()->first;
  for (auto& [number, entry] : frames) {
    const double time_us = static_cast<double>(number - first) * 1e6 / listing.rate_hz;
    entry.timestamp_us = std::llround(std::min(time_us, kLatest_us));
    listing.entries.push_back(std::move(entry));
  }
  return listing;
}

}  // namespace saccade
