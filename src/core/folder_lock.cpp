#include "core/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr const char* kLockFile = ".saccade.lock";
constexpr const char* kHint = "choose another folder, or wait until it has ended";

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

// The first line of the lock's file: its owner.
std::string read_owner(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  const std::string owner(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  const std::string line = owner.substr(0, owner.find('\n'));
  return line.empty() ? "another process" : line;
}

}  // namespace

std::string lock_owner(const std::filesystem::path& folder) {
  const int descriptor = ::open((folder / kLockFile).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return "";
  const bool taken = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::string owner = taken ? read_owner(descriptor) : "";
  ::close(descriptor);
  return owner;
}

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& owner)
    : path_(folder / kLockFile) {
  while (!take()) {
  }
  const std::string line = fmt::format("{}, process {} on {}\n", owner, ::getpid(), host_name());
  if (::ftruncate(descriptor_, 0) != 0 ||
      ::pwrite(descriptor_, line.data(), line.size(), 0) != static_cast<ssize_t>(line.size())) {
    const int code = errno;
    ::unlink(path_.c_str());
    ::close(descriptor_);
    throw failed(std::string("cannot write: ") + std::strerror(code), path_.string(),
                 "is the folder writable and the disk not full?");
  }
}

// False if the owner before removed the file between our opening and locking it: it must be opened again.
bool FolderLock::take() {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (descriptor_ < 0)
    throw failed(std::string("cannot lock the folder: ") + std::strerror(errno), path_.string(),
                 "is the folder writable?");
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const int code = errno;
    const std::string owner = read_owner(descriptor_);
    ::close(descriptor_);
    if (code == EWOULDBLOCK)
      throw failed("the folder is in use by " + owner, path_.parent_path().string(), kHint);
    throw failed(std::string("cannot lock the folder: ") + std::strerror(code), path_.string(),
                 "does the file system support locks?");
  }
  struct stat ours {
  }, there{};
  const bool same = ::fstat(descriptor_, &ours) == 0 && ::lstat(path_.c_str(), &there) == 0 &&
                    ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
  if (!same) ::close(descriptor_);
  return same;
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace saccade
