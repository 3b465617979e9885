#pragma once

#include <sys/types.h>

#include <string>

namespace saccade {

/// Whether a program of this name can be started.
bool is_installed(const char* program);

/// An X server of its own without a screen (Xvfb), which ends with the object.
class XServer {
 public:
  XServer() = default;
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  /// Returns false if it did not start. Once.
  bool start();

  /// For DISPLAY, as ":5".
  const std::string& display() const { return display_; }

 private:
  pid_t server_ = -1;
  std::string display_;
};

}  // namespace saccade
