#include "oni/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace saccade {

InputFile::InputFile(const std::filesystem::path& path)
    // Without O_NONBLOCK a named pipe would wait here for a writer.
    : InputFile(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK), path.string()) {}

InputFile::InputFile(int descriptor, std::string name) : name_(std::move(name)), descriptor_(descriptor) {
  const char* hint = "check the path and its permissions";
  if (descriptor_ < 0) throw unreadable(std::string("cannot open: ") + std::strerror(errno), name_, hint);
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw unreadable("not a file", name_, hint);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(std::uint64_t position, std::span<std::uint8_t> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size() && position + done < size_) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(position + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace saccade
