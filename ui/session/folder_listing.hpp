#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <vector>

namespace saccade {

/// A folder as a user chooses a source from it.
struct FolderContents {
  struct Entry {
    std::string name;
    bool folder = false;  ///< it can be entered
    bool source = false;  ///< it can be opened
    bool operator==(const Entry&) const = default;
  };
  std::string folder;          ///< absolute where possible
  std::string parent;          ///< empty = it has none
  bool source = false;         ///< the folder itself can be opened
  std::vector<Entry> entries;  ///< folders, then files that can be opened, by name; without hidden ones
  bool more = false;           ///< there are more than kMostEntries
  std::string error;           ///< why it cannot be listed; empty = it can
  static constexpr std::size_t kMostEntries = 500;
};

/// Lists the folder `typed`, or the nearest folder above it that exists; an empty text is the working
/// directory. Never throws: a folder that cannot be read, or a name that is too long, is an `error`.
[[nodiscard]] FolderContents list_folder(const std::string& typed);

/// Lists a folder on a thread of its own, since a network disk may take long. One thread at a time.
class FolderLister {
 public:
  /// `wake` is called on any thread when there is a new listing.
  explicit FolderLister(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// The newest listing, as list_folder(); lists `typed` again if it has changed, and every two seconds.
  [[nodiscard]] const FolderContents& poll(const std::string& typed);

 private:
  const std::function<void()> wake_;
  std::string typed_;  // of the listing that was begun last
  bool begun_ = false;
  std::chrono::steady_clock::time_point begun_at_;
  FolderContents contents_;
  std::future<FolderContents> listing_;
};

}  // namespace saccade
