#include "core/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr const char* kWriteHint = "is the folder writable and the disk not full?";

Error write_error(const std::filesystem::path& path, int code) {
  return failed(std::string("cannot write: ") + std::strerror(code), path.string(), kWriteHint);
}

// Writes all bytes or returns the errno of the failure.
int write_all(int descriptor, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::uintmax_t limit) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code)
    throw unreadable("cannot read: " + code.message(), path.string(), "check the path and its permissions");
  if (size > limit) throw unreadable("file too large", path.string(), "is this the right file?");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file) throw unreadable("cannot read the file", path.string(), "check its permissions and the disk");
  return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  write_file(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  // A device such as /dev/full is written in place: a rename would replace it.
  std::error_code code;
  const bool special = std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code);
  const std::string target = special ? path.string() : path.string() + ".part";
  const int descriptor = ::open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw write_error(path, errno);
  int problem = write_all(descriptor, text.data(), text.size());
  if (::close(descriptor) != 0 && problem == 0) problem = errno;
  if (problem == 0 && !special && std::rename(target.c_str(), path.c_str()) != 0) problem = errno;
  if (problem != 0) {
    if (!special) ::unlink(target.c_str());
    throw write_error(path, problem);
  }
}

std::string megabytes(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6) : fmt::format("{:.2f} GB", bytes / 1e9);
}

LineFile::LineFile(const std::filesystem::path& path, Existing existing) : path_(path) {
  const int emptied = existing == Existing::replace ? O_TRUNC : 0;
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | emptied, 0666);
  if (descriptor_ < 0) throw write_error(path_, errno);
  size_ = std::max<std::int64_t>(0, ::lseek(descriptor_, 0, SEEK_END));  // a device has no end
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::append(std::string_view line) {
  std::string text(line);
  text += '\n';
  if (const int problem = write_all(descriptor_, text.data(), text.size()); problem != 0) {
    if (::ftruncate(descriptor_, size_) == 0) ::lseek(descriptor_, size_, SEEK_SET);
    throw write_error(path_, problem);
  }
  size_ += static_cast<std::int64_t>(text.size());
}

}  // namespace saccade
