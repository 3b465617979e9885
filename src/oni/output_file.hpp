#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace saccade {

/// A new file that grows by whole blocks and keeps room on the disk, so that what must still be written at
/// the end finds its place even when the disk fills up. Thread safety: one call at a time.
class OutputFile {
 public:
  /// Creates the file. With `overwrite` an existing one is replaced, without it that is an Error (usage).
  /// Throws Error (failed) if it cannot be created.
  OutputFile(const std::filesystem::path& path, bool overwrite);
  /// Closes the file; it stays as it is.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// Makes sure that the file can grow by `bytes` from its present size: takes blocks of the disk ahead of
  /// the end of the file, and respects the process's file-size limit. False if the disk (or quota, or limit)
  /// has no room for them.
  [[nodiscard]] bool reserve(std::uint64_t bytes);

  /// Appends all of `bytes` or, if that fails, nothing: the file is cut back to where it was. False if there
  /// is no room. Throws Error (failed) for any other failure.
  [[nodiscard]] bool append(std::span<const std::uint8_t> bytes);

  /// Writes over bytes that are there already. Throws Error (failed).
  void overwrite(std::uint64_t position, std::span<const std::uint8_t> bytes);

  /// Waits until everything is on the disk. Throws Error (failed).
  void flush();

  /// Waits until the folder's entry for the file is on the disk; without it, a power cut may take the file as
  /// a whole. Does nothing where folders cannot be flushed.
  void flush_folder();

  /// Gives back the room that was kept and not used.
  void release_reserve();

  /// Removes the file from its folder.
  void remove();

 private:
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t reserved_ = 0;  // the file has blocks up to here
};

}  // namespace saccade
