#pragma once

#include <filesystem>
#include <string>

namespace saccade {

/// The owner of the lock of a folder, as "saccade run, process 12 on host"; empty = nobody has it.
[[nodiscard]] std::string lock_owner(const std::filesystem::path& folder);

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
