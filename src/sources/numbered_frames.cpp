#include "sources/numbered_frames.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
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

std::string lower_case(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

FolderNames::FolderNames(const fs::path& folder) : folder_(folder) {
  std::vector<std::string> names;
  for (const auto& file : fs::directory_iterator(folder.empty() ? fs::path(".") : folder))
    names.push_back(file.path().filename().string());
  std::ranges::sort(names, std::greater{});  // of two that differ in case only, the same on every machine
  for (std::string& name : names) names_.emplace(lower_case(name), name);
}

std::vector<std::string> FolderNames::all() const {
  std::vector<std::string> names;
  for (const auto& [lower, name] : names_) names.push_back(name);
  return names;
}

fs::path FolderNames::first_of(std::initializer_list<std::string> names) const {
  for (const std::string& name : names)
    if (const auto found = names_.find(lower_case(name)); found != names_.end())
      return folder_ / found->second;
  return {};
}

FolderListing list_by_number(std::map<std::int64_t, FolderEntry> frames,
                             const std::map<std::int64_t, std::int64_t>& times_us) {
  constexpr double kLatest_us = 9e18;  // numbers can be as large as integers are
  FolderListing listing;
  if (frames.empty()) return listing;
  if (const auto gaps = describe_gaps(frames)) listing.notes.push_back(*gaps);
  const std::int64_t first = frames.begin()->first;
  std::size_t without = 0;
  std::int64_t before_us = 0;
  for (auto& [number, entry] : frames) {
    const double time_us = static_cast<double>(number - first) * 1e6 / listing.rate_hz;
    entry.timestamp_us = std::llround(std::min(time_us, kLatest_us));
    if (const auto time = times_us.find(number); time != times_us.end()) {
      entry.timestamp_us = time->second;
    } else if (!times_us.empty()) {
      entry.timestamp_us = before_us + std::llround(1e6 / listing.rate_hz);
      ++without;
    }
    before_us = entry.timestamp_us;
    listing.entries.push_back(std::move(entry));
  }
  if (without > 0)
    listing.notes.push_back(
        fmt::format("{} of {} frames have no time in the list of times", without, listing.entries.size()));
  listing.sequence = !times_us.empty();
  return listing;
}

}  // namespace saccade
