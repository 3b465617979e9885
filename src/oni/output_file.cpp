#include "oni/output_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr std::uint64_t kReserveStep = 4u << 20;  // so that few writes need a call of fallocate()

Error write_error(const std::string& name, const char* what, int code) {
  return failed(std::string(what) + ": " + std::strerror(code), name,
                "check that the folder is writable and the disk healthy");
}

bool is_full(int code) { return code == ENOSPC || code == EDQUOT || code == EFBIG; }

// The largest size that this process may give a file.
std::uint64_t size_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<std::uint64_t>::max();
  return limit.rlim_cur;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, bool overwrite) : name_(path.string()) {
  // An existing file is replaced, not emptied: another process may be reading it, and no frame may come.
  std::error_code ignored;
  if (overwrite && std::filesystem::is_regular_file(path, ignored)) {
    temporary_name_ = name_ + ".part";
    ::unlink(temporary_name_.c_str());  // of a process that was killed
  }
  const std::string& target = is_published() ? name_ : temporary_name_;
  descriptor_ = ::open(target.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ >= 0) return;
  if (errno == EEXIST)
    throw usage_error("the file exists", name_, "choose another name, or --force to replace it");
  throw write_error(name_, "cannot create", errno);
}

OutputFile::~OutputFile() {
  if (!is_published()) remove();
  ::close(descriptor_);
}

void OutputFile::publish() {
  if (is_published()) return;
  flush();
  if (::rename(temporary_name_.c_str(), name_.c_str()) != 0)
    throw write_error(name_, "cannot replace the file", errno);
  temporary_name_.clear();
  flush_folder();
}

void OutputFile::check_in_place() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && status.st_nlink == 0)
    throw failed("the file was deleted while it was being written", name_, "start again");
}

bool OutputFile::reserve(std::uint64_t bytes) {
  const std::uint64_t wanted = size_ + bytes;
  // A write beyond the limit would raise the signal SIGXFSZ.
  if (wanted > size_limit()) return false;
  if (wanted <= reserved_) return true;
  for (const std::uint64_t target : {wanted + kReserveStep, wanted}) {
    int code = 0;
    do {
      code = ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(size_),
                         static_cast<off_t>(target - size_)) == 0
                 ? 0
                 : errno;
    } while (code == EINTR);
    if (code == 0) {
      reserved_ = target;
      return true;
    }
    if (!is_full(code)) break;  // the file system cannot reserve: check the free space below
    if (target == wanted) return false;
  }
  struct statvfs disk {};
  if (::fstatvfs(descriptor_, &disk) != 0) return true;
  return static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize >= bytes;
}

bool OutputFile::append(std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written =
        ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(size_ + done));
    if (written > 0) {
      done += static_cast<std::size_t>(written);
      continue;
    }
    const int code = written == 0 ? ENOSPC : errno;
    if (code == EINTR) continue;
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0)
      throw write_error(name_, "cannot write", errno);
    reserved_ = 0;  // ftruncate() has released the reserved blocks
    if (is_full(code)) return false;
    throw write_error(name_, "cannot write", code);
  }
  size_ += bytes.size();
  return true;
}

void OutputFile::overwrite(std::uint64_t position, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written =
        ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(position + done));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw write_error(name_, "cannot write", errno);
    done += static_cast<std::size_t>(written);
  }
}

void OutputFile::flush() {
  // Some special file systems cannot sync, and there is nothing to wait for.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    throw write_error(name_, "cannot write to the disk", errno);
}

void OutputFile::flush_folder() {
  const auto folder = std::filesystem::path(name_).parent_path() / ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // the folder is writable but not readable
  ::fsync(descriptor);
  ::close(descriptor);
}

void OutputFile::release_reserve() {
  if (reserved_ > size_ && ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0)
    throw write_error(name_, "cannot write", errno);
  reserved_ = 0;
}

void OutputFile::remove() { ::unlink(is_published() ? name_.c_str() : temporary_name_.c_str()); }

}  // namespace saccade
