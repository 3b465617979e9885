#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace saccade {

/// As write_file(), for a file that is written in pieces: finish() makes it complete, and without it there is
/// none.
class FileWriter {
 public:
  /// Throws Error (failed).
  explicit FileWriter(const std::filesystem::path& path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Both throw Error (failed).
  void write(std::string_view text);
  void finish();

 private:
  void flush();

  std::filesystem::path path_;
  bool in_place_;       // a device
  std::string target_;  // what is written
  int descriptor_ = -1;
  std::string buffer_;
};

}  // namespace saccade
