#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "sources/folder_source.hpp"

namespace saccade {

/// The names in a folder, read once: thousands of questions to the file system would take longer.
class FolderNames {
 public:
  /// Throws std::filesystem::filesystem_error if the folder cannot be listed.
  explicit FolderNames(const std::filesystem::path& folder);

  std::vector<std::string> all() const;

  /// The path of the first of these files that the folder has, in letters of any case; empty if it has none.
  std::filesystem::path first_of(std::initializer_list<std::string> names) const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::string> names_;  // by the name in lower case
};

/// A name in lower case, as far as it is ASCII.
std::string lower_case(std::string name);

/// The listing of frames by their numbers, which are not negative. Frame N has its time in `times_us`; where
/// there are no times, it is at N / 30 s from the first. A frame without one among others that have is 1/30 s
/// after the frame before it. Gaps in the numbering are a note, and so are frames without a time.
FolderListing list_by_number(std::map<std::int64_t, FolderEntry> frames,
                             const std::map<std::int64_t, std::int64_t>& times_us = {});

}  // namespace saccade
