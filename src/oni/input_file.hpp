#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace saccade {

/// A file for reading at any position. It never maps the file, since one that shrinks while it is open would
/// then raise SIGBUS. The size is that of the moment of opening; what was cut since reads as missing.
/// Thread safety: read() may be called by several threads.
class InputFile {
 public:
  /// Throws Error (unreadable) if there is no such regular file or it cannot be opened.
  explicit InputFile(const std::filesystem::path& path);
  /// Takes over an open descriptor of a regular file; `name` is for messages.
  InputFile(int descriptor, std::string name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// Reads up to bytes.size() bytes from `position`; returns how many there were, fewer only at the end of
  /// the file or where the disk cannot read.
  std::size_t read(std::uint64_t position, std::span<std::uint8_t> bytes) const;

 private:
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace saccade
