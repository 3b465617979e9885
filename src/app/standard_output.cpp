#include "app/standard_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "output/json_text.hpp"

namespace saccade {
namespace {

void print(std::string_view text, Reader reader = Reader::stays) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE && reader == Reader::may_leave) return;
  throw failed(std::string("cannot write: ") + std::strerror(errno), "standard output",
               "is the disk full, or the reader gone?");
}

}  // namespace

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
      // The lowest free number is this one, since those below are open.
      const int opened = ::open("/dev/null", O_RDWR);
      if (opened >= 0 && opened != descriptor) ::close(opened);
    }
}

void print_text(std::string_view text, Reader reader) { print(printable_lines(text), reader); }

void print_json(const nlohmann::ordered_json& json, int indent) { print(dump(json, indent) + "\n"); }

}  // namespace saccade
