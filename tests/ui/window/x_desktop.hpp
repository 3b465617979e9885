#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace saccade {

/// Stands in for the desktop, on a display without one: drops files onto a window like a file manager (XDND
/// 5), has a clipboard like another program, and minimises and restores the window like a window manager.
class XDesktop {
 public:
  /// For the first window of the class on the display. Throws std::runtime_error if there is none.
  XDesktop(const std::string& display, const std::string& window_class);
  ~XDesktop();
  XDesktop(const XDesktop&) = delete;
  XDesktop& operator=(const XDesktop&) = delete;

  /// Returns whether the window accepted the file; false too if it does not answer within a minute.
  bool drop(const std::filesystem::path& file);

  /// Puts a text into the clipboard.
  void copy(const std::string& text);
  /// Hands the clipboard to the window that asks for it; false if none does within a minute.
  bool paste();

  void minimise() { set_minimised(true); }
  void restore() { set_minimised(false); }

 private:
  struct Client;  // Xlib's names are kept out of the tests
  void set_minimised(bool minimised);
  std::unique_ptr<Client> client_;
};

}  // namespace saccade
