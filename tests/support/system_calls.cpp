#include "tests/support/system_calls.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <utility>

namespace saccade {
namespace {

SystemCalls* present = nullptr;

void run_once(std::function<void()> SystemCalls::*hook) {
  if (present == nullptr || !(present->*hook)) return;
  std::exchange(present->*hook, nullptr)();
}

}  // namespace

SystemCalls::SystemCalls() { present = this; }
SystemCalls::~SystemCalls() { present = nullptr; }

ssize_t SystemCalls::real_write(int file, const void* bytes, std::size_t count) {
  return ::syscall(SYS_write, file, bytes, count);
}

}  // namespace saccade

extern "C" ssize_t write(int file, const void* bytes, size_t count) {
  const auto* calls = saccade::present;
  return calls != nullptr && calls->write ? calls->write(file, bytes, count)
                                          : saccade::SystemCalls::real_write(file, bytes, count);
}

extern "C" int flock(int file, int operation) noexcept {
  saccade::run_once(&saccade::SystemCalls::before_flock);
  return static_cast<int>(::syscall(SYS_flock, file, operation));
}

extern "C" int unlink(const char* path) noexcept {
  saccade::run_once(&saccade::SystemCalls::before_unlink);
  return static_cast<int>(::syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}
