#include "tests/ui/support/x_server.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace saccade {

bool is_installed(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null").c_str()) == 0;
}

XServer::~XServer() {
  if (server_ <= 0) return;
  ::kill(server_, SIGTERM);
  ::waitpid(server_, nullptr, 0);
}

bool XServer::start() {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return false;
  server_ = ::fork();
  if (server_ == 0) {
    ::dup2(ends[1], 3);
    const int null = ::open("/dev/null", O_WRONLY);
    ::dup2(null, STDERR_FILENO);
    ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1920x1200x24", nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  std::string number;
  char c = 0;  // the server writes its number when it is ready
  while (::read(ends[0], &c, 1) == 1 && c != '\n') number += c;
  ::close(ends[0]);
  display_ = ":" + number;
  return !number.empty();
}

}  // namespace saccade
