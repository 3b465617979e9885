#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <unordered_set>

#include "sources/folder_source.hpp"

namespace saccade {

/// The names in a folder, read once: thousands of questions to the file system would take longer.
class FolderNames {
 public:
  /// Throws std::filesystem::filesystem_error if the folder cannot be listed.
  explicit FolderNames(const std::filesystem::path& folder);

  const std::unordered_set<std::string>& all() const { return names_; }

  /// The path of the first of these files that the folder has; empty if it has none.
  std::filesystem::path first_of(std::initializer_list<std::string> names) const;

 private:
  std::filesystem::path folder_;
  std::unordered_set<std::string> names_;
};

/// The listing of frames by their numbers, which are not negative: frame N is at N / 30 s from the first.
/// Gaps in the numbering are a note.
FolderListing list_by_number(std::map<std::int64_t, FolderEntry> frames);

}  // namespace saccade
