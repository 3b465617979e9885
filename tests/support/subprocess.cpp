#include "tests/support/subprocess.hpp"
#include "tests/support/places.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

std::string read_text(const fs::path& path) {
  const auto bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

bool has_ended(pid_t child) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid == child;
}

}  // namespace

::testing::AssertionResult ProgramResult::one_error_line() const {
  const auto lines = std::count(err.begin(), err.end(), '\n');
  if (lines == 1 && err.starts_with("saccade: ")) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "not one line: " << err;
}

ProgramResult run_saccade(const std::vector<std::string>& arguments, int interrupt_after_ms,
                          const fs::path& wait_for, int signal) {
  return run_program(saccade_program(), arguments, interrupt_after_ms, wait_for, signal);
}

ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          int interrupt_after_ms, const fs::path& wait_for, int signal) {
  const fs::path base = fs::path(::testing::TempDir()) / ("saccade_" + std::to_string(::getpid()));
  const std::string out = base.string() + ".out", err = base.string() + ".err";
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const int o = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int e = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(o, STDOUT_FILENO);
    ::dup2(e, STDERR_FILENO);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  if (interrupt_after_ms >= 0) {
    while (!fs::exists(wait_for) && !has_ended(child))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after_ms));
    ::kill(child, signal);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ProgramResult outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_text(out),
                        read_text(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::string ProgramTest::text(const std::string& name) const { return read_text(folder_ / name); }

}  // namespace saccade
