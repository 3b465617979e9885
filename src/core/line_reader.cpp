#include "core/line_reader.hpp"

#include <algorithm>
#include <fstream>
#include <utility>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 30;

}  // namespace

LineReader::LineReader(std::filesystem::path path, std::uintmax_t begin, std::uintmax_t end,
                       std::size_t piece)
    : path_(std::move(path)), end_(end), piece_(piece), position_(begin) {}

bool LineReader::next(std::string_view& line) {
  std::size_t searched = taken_;
  for (;;) {
    const std::size_t end = buffer_.find('\n', searched);
    if (end != std::string::npos) {
      line = std::string_view(buffer_).substr(taken_, end - taken_);
      position_ += line.size() + 1;
      taken_ = end + 1;
      return true;
    }
    const std::size_t seen = buffer_.size() - taken_;
    if (!read_more()) return false;
    searched = seen;
  }
}

// Drops the lines that were given and appends the next piece; false at the end.
bool LineReader::read_more() {
  buffer_.erase(0, std::exchange(taken_, 0));
  if (buffer_.size() > kLongestLine)
    throw unreadable("a line is too long", path_.string(), "is this the right file?");
  const std::uintmax_t from = position_ + buffer_.size();
  if (from >= end_) return false;
  const auto expect = [&](bool holds) {
    if (!holds)
      throw unreadable("cannot read the file", path_.string(), "check the path and its permissions");
  };
  std::ifstream file(path_, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.is_open() ? std::streamoff{file.tellg()} : -1;
  expect(size >= 0);
  const std::uintmax_t end = std::min(end_, static_cast<std::uintmax_t>(size));
  if (from >= end) return false;
  const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(piece_, end - from));
  file.seekg(static_cast<std::streamoff>(from));
  const std::size_t before = buffer_.size();
  buffer_.resize(before + wanted);
  file.read(buffer_.data() + before, static_cast<std::streamsize>(wanted));
  expect(!file.bad() && (file || file.eof()));
  buffer_.resize(before + static_cast<std::size_t>(file.gcount()));
  return buffer_.size() > before;
}

}  // namespace saccade
