#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace saccade {

/// The whole content of a file. Throws Error (unreadable) naming the file, also above `limit` bytes.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::uintmax_t limit = 1u << 30);

/// Writes a file so that it is either whole or absent: a temporary name beside it, then a rename.
/// Throws Error (failed) naming the file and the system's reason; nothing half-written stays.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// A size for people: "12.3 MB", or "4.56 GB" from 1 GB on.
std::string megabytes(double bytes);

/// A text file that grows line by line; each line reaches the system in one write, so that what is there is
/// whole.
class LineFile {
 public:
  enum class Existing { replace, keep };

  /// Creates the file; one that exists is emptied, or appended to. Throws Error (failed).
  explicit LineFile(const std::filesystem::path& path, Existing existing = Existing::replace);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends `line` and a line feed. Throws Error (failed), after cutting back what was written of the line.
  void append(std::string_view line);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace saccade
