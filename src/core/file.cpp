#include "core/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file_writer.hpp"

namespace saccade {
namespace {

constexpr const char* kWriteHint = "is the folder writable and the disk not full?";

Error write_error(const std::filesystem::path& path, int code) {
  return failed(std::string("cannot write: ") + std::strerror(code), path.string(), kWriteHint);
}

// A device such as /dev/full is written in place: a rename would replace it.
bool is_device(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::is_character_file(path, code);
}

// Settings of "--config /dev/null" are none.
bool is_null_device(const std::filesystem::path& path) {
  struct stat null {};
  struct stat named {};
  return ::stat("/dev/null", &null) == 0 && ::stat(path.c_str(), &named) == 0 && S_ISCHR(named.st_mode) &&
         named.st_rdev == null.st_rdev;
}

// Opens without waiting for the reader of a pipe, and follows a symbolic link only to a device. Negative,
// with errno, if that fails.
int open_to_write(const std::string& path, int flags) {
  const int link = is_device(path) ? 0 : O_NOFOLLOW;
  return ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | link | flags, 0666);
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
  if (is_null_device(path)) return {};
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code == std::errc::not_supported)
    throw unreadable("a pipe, socket or device instead of a file", path.string(),
                     "copy its content to a file");
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
  FileWriter file(path);
  file.write(text);
  file.finish();
}

FileWriter::FileWriter(const std::filesystem::path& path)
    : path_(path), in_place_(is_device(path)), target_(in_place_ ? path.string() : path.string() + ".part") {
  if (!in_place_) {
    std::error_code code;
    if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
      throw failed("cannot write: not a regular file", path.string(), "choose another name");
    ::unlink(target_.c_str());  // of a process that was killed
  }
  descriptor_ = open_to_write(target_, in_place_ ? 0 : O_CREAT | O_EXCL);
  if (descriptor_ < 0) throw write_error(path, errno);
}

FileWriter::~FileWriter() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!in_place_) ::unlink(target_.c_str());
}

void FileWriter::write(std::string_view text) {
  constexpr std::size_t kBuffer = 1u << 20;
  if (buffer_.size() + text.size() > kBuffer) flush();
  if (text.size() <= kBuffer) {
    buffer_ += text;
    return;
  }
  if (const int problem = write_all(descriptor_, text.data(), text.size()); problem != 0)
    throw write_error(path_, problem);
}

void FileWriter::flush() {
  if (const int problem = write_all(descriptor_, buffer_.data(), buffer_.size()); problem != 0)
    throw write_error(path_, problem);
  buffer_.clear();
}

void FileWriter::finish() {
  flush();
  int problem = 0;
  if (::close(std::exchange(descriptor_, -1)) != 0) problem = errno;
  if (problem == 0 && !in_place_ && std::rename(target_.c_str(), path_.c_str()) != 0) problem = errno;
  if (problem == 0) return;
  if (!in_place_) ::unlink(target_.c_str());
  throw write_error(path_, problem);
}

std::string megabytes(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6) : fmt::format("{:.2f} GB", bytes / 1e9);
}

LineFile::LineFile(const std::filesystem::path& path, Existing existing) : path_(path) {
  std::error_code code;
  if (std::filesystem::is_symlink(path, code) && !is_device(path))
    throw failed("cannot write: it is a symbolic link", path_.string(), "delete it");
  const int emptied = existing == Existing::replace ? O_TRUNC : 0;
  descriptor_ = open_to_write(path_.string(), O_CREAT | emptied);
  if (descriptor_ < 0) throw write_error(path_, errno);
  struct stat status {};
  is_regular_ = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!is_regular_ && !S_ISCHR(status.st_mode)) {
    ::close(descriptor_);
    throw failed("cannot write: not a regular file", path_.string(), "delete it");
  }
  size_ = std::max<std::int64_t>(0, ::lseek(descriptor_, 0, SEEK_END));  // a device has no end
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::append(std::string_view line) {
  check_in_place();
  std::string text(line);
  text += '\n';
  if (const int problem = write_all(descriptor_, text.data(), text.size()); problem != 0) {
    if (::ftruncate(descriptor_, size_) == 0) ::lseek(descriptor_, size_, SEEK_SET);
    throw write_error(path_, problem);
  }
  size_ += static_cast<std::int64_t>(text.size());
}

void LineFile::check_in_place() const {
  struct stat status {};
  if (is_regular_ && ::fstat(descriptor_, &status) == 0 && status.st_nlink == 0)
    throw failed("the file was deleted while it was being written", path_.string(), "start again");
}

}  // namespace saccade
