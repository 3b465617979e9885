#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace saccade {

/// The content of a file. Throws Error (unreadable) naming the file, also if it has more than `limit` bytes.
[[nodiscard]] std::vector<std::uint8_t> read_file(const std::filesystem::path& path,
                                                  std::uintmax_t limit = 1u << 30);

/// Writes a file completely or not at all: under a temporary name beside it, then renamed. Throws Error
/// (failed) naming the file and the system's reason.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// "12.3 MB", or "4.56 GB" from 1 GB on.
std::string megabytes(double bytes);

/// A text file that grows line by line. Each line reaches the system in one write, so that the file never
/// holds half a line.
class LineFile {
 public:
  enum class Existing { replace, keep };

  /// Creates the file, or empties or continues an existing one. Throws Error (failed).
  explicit LineFile(const std::filesystem::path& path, Existing existing = Existing::replace);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends `line` and a line feed. Throws Error (failed), after removing the part of the line that was
  /// written.
  void append(std::string_view line);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace saccade
