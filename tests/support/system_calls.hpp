#pragma once

#include <sys/types.h>

#include <functional>

namespace saccade {

/// What a program that links system_calls.cpp does in place of a system call, or before it, as long as this
/// object lives. One at a time.
class SystemCalls {
 public:
  SystemCalls();
  ~SystemCalls();
  SystemCalls(const SystemCalls&) = delete;
  SystemCalls& operator=(const SystemCalls&) = delete;

  /// In place of write(); sets errno if it returns a negative number.
  std::function<ssize_t(int file, const void* bytes, std::size_t count)> write;
  /// Once, before the next call.
  std::function<void()> before_flock, before_unlink;

  static ssize_t real_write(int file, const void* bytes, std::size_t count);
};

}  // namespace saccade
