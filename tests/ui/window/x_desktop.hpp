#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace saccade {

/// What a desktop does to a program's window, on a display where there is none: drops a file onto it as a
/// file manager would (XDND 5), minimises it and brings it back as a window manager would.
class XDesktop {
 public:
  /// The first window of the class on the display. Throws std::runtime_error if there is none.
  XDesktop(const std::string& display, const std::string& window_class);
  ~XDesktop();
  XDesktop(const XDesktop&) = delete;
  XDesktop& operator=(const XDesktop&) = delete;

  /// Returns whether the window has taken it; false too if it does not answer within a minute.
  bool drop(const std::filesystem::path& file);

  void minimise() { set_minimised(true); }
  void restore() { set_minimised(false); }

 private:
  struct Client;  // Xlib's names are kept out of the tests
  void set_minimised(bool minimised);
  std::unique_ptr<Client> client_;
};

}  // namespace saccade
