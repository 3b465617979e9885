#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace saccade {

/// A new file that reserves space on the disk ahead of its end, so that the closing records fit even on a
/// disk that has become full (README 9). Thread safety: one call at a time.
class OutputFile {
 public:
  /// Creates the file. An existing one is an Error (usage), unless `overwrite` is set: then the new file is
  /// written beside it as NAME.part, and replaces it with publish(). Throws Error (failed) if it cannot be
  /// created.
  OutputFile(const std::filesystem::path& path, bool overwrite);
  /// Closes the file and keeps it; a file that was to replace another and was not published is removed.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// Ensures that the file can grow by `bytes`: reserves blocks ahead of its end, and respects the process's
  /// limit on file size. False if the disk (or quota, or limit) has no room. Where the file system cannot
  /// reserve, it only checks the free space.
  [[nodiscard]] bool reserve(std::uint64_t bytes);

  /// Appends all of `bytes` or, if that fails, nothing: the file is truncated to its size before. False if
  /// there is no room. Throws Error (failed) for any other failure.
  [[nodiscard]] bool append(std::span<const std::uint8_t> bytes);

  /// Replaces the file of this name that existed before, once this one holds something. Does nothing if there
  /// was none. Throws Error (failed).
  void publish();

  /// Throws Error (failed) if the file was deleted from its folder meanwhile.
  void check_in_place() const;

  /// Replaces existing bytes. Throws Error (failed).
  void overwrite(std::uint64_t position, std::span<const std::uint8_t> bytes);

  /// Waits until everything is on the disk. Throws Error (failed).
  void flush();

  /// Waits until the entry of the file in its folder is on the disk; before that, a power failure may remove
  /// the file as a whole. Does nothing where folders cannot be synced.
  void flush_folder();

  /// Releases the reserved blocks that are not used.
  void release_reserve();

  /// Removes the file from its folder. A file that it was to replace stays.
  void remove();

 private:
  bool is_published() const { return temporary_name_.empty(); }

  std::string name_, temporary_name_;  // empty once the file has its name
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t reserved_ = 0;  // the file has blocks up to this size
};

}  // namespace saccade
