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

/// Writes a file completely or not at all: as PATH.part, then renamed, so that a symbolic link of either name
/// is replaced and not followed. Only a device such as /dev/full is written in place. One process at a time
/// may write a file. Throws Error (failed) naming the file and the system's reason.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// "12.3 MB", or "4.56 GB" from 1 GB on.
std::string megabytes(double bytes);

/// A text file that grows line by line. Each line reaches the system in one write, so that the file never
/// holds half a line.
class LineFile {
 public:
  enum class Existing { replace, keep };

  /// Creates the file, or empties or continues an existing one. Throws Error (failed), also for a symbolic
  /// link, unless to a device such as /dev/full, and for a pipe.
  explicit LineFile(const std::filesystem::path& path, Existing existing = Existing::replace);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends `line` and a line feed. Throws Error (failed), after removing the part of the line that was
  /// written; also if the file was deleted meanwhile.
  void append(std::string_view line);

  /// To be called after the last line. Throws Error (failed) if the file was deleted meanwhile.
  void check_in_place() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool is_regular_ = false;  // not a device
  std::int64_t size_ = 0;
};

}  // namespace saccade
