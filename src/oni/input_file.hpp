#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace saccade {

/// A file for reading at any position. It is not mapped: a mapped file that shrinks raises SIGBUS. The size
/// is that of the moment of opening; bytes that have been cut off since are missing. Thread safety: several
/// threads may call read().
class InputFile {
 public:
  /// Throws Error (unreadable) if it is not a regular file or cannot be opened.
  explicit InputFile(const std::filesystem::path& path);
  /// Owns an open descriptor of a regular file from here on; `name` is for messages.
  InputFile(int descriptor, std::string name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// Reads bytes.size() bytes from `position`; returns their number, smaller only at the end of the file or
  /// at a read error of the disk.
  std::size_t read(std::uint64_t position, std::span<std::uint8_t> bytes) const;

 private:
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace saccade
