#pragma once

#include <filesystem>
#include <string>

namespace saccade {

/// While it lives, no other process can take the lock of the same folder. The file `.saccade.lock` in it
/// names the owner. The system releases the lock of a process that was killed.
class FolderLock {
 public:
  /// `owner`: what the process does, for the error of others, e.g. "saccade run". Throws Error (failed):
  /// another process has the lock, and its name; or the file cannot be written.
  FolderLock(const std::filesystem::path& folder, const std::string& owner);
  /// Removes the file.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  bool take();

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace saccade
