#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace saccade {

/// Reads the complete lines of a part of a text file one by one, with the memory of a few lines. The file is
/// open only while a piece of it is being read, so that thousands of readers can take turns.
class LineReader {
 public:
  /// The part from byte `begin` to byte `end`; `piece` bytes are read at a time.
  explicit LineReader(std::filesystem::path path, std::uintmax_t begin = 0, std::uintmax_t end = UINTMAX_MAX,
                      std::size_t piece = 1u << 20);

  /// The next line without its line feed, valid until the next call; false at the end, also before a last
  /// line without line feed. Throws Error (unreadable) if the file cannot be read, or for a line above 1 GiB.
  [[nodiscard]] bool next(std::string_view& line);

  /// Where the line after the last one begins.
  std::uintmax_t position() const { return position_; }

 private:
  bool read_more();

  std::filesystem::path path_;
  std::uintmax_t end_;
  std::size_t piece_;
  std::uintmax_t position_;  // in the file, of the next line
  std::string buffer_;       // holds the file from position_ - taken_ on
  std::size_t taken_ = 0;    // bytes of the buffer that were given
};

}  // namespace saccade
