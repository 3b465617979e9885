#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace saccade {

/// A file dialog of the desktop.
struct FileDialog {
  enum class Kind { open_file, open_folder, save_file };
  Kind kind = Kind::open_file;
  std::string title;
  std::string folder;  ///< shown first; empty = the desktop's choice
  std::string name;    ///< suggested name of a file to save
  std::string
      parent;  ///< the window that it belongs to, as the portal names windows ("x11:2a"); empty = none
};

/// The file dialogs of the desktop, which its portal shows (org.freedesktop.portal.FileChooser on the session
/// bus): they know the user's bookmarks and network places, and work from within a sandbox. The bus is used
/// on a thread of its own, so that no function here waits. One dialog at a time. All functions on one thread.
class FilePortal {
 public:
  /// Looks for the portal. `wake` is called on the portal's thread when something has changed.
  explicit FilePortal(std::function<void()> wake);
  /// The desktop closes an open dialog.
  ~FilePortal();
  FilePortal(const FilePortal&) = delete;
  FilePortal& operator=(const FilePortal&) = delete;

  /// Whether dialogs can be shown: false where there is no bus, no portal, or no answer of it yet.
  [[nodiscard]] bool available() const;

  /// A dialog is shown and has not been answered.
  [[nodiscard]] bool busy() const { return chosen_ != nullptr; }

  /// Shows a dialog; `chosen` gets the path from poll() unless the user cancels. Nothing while busy().
  void show(const FileDialog& dialog, std::function<void(const std::string& path)> chosen);

  /// Passes on the answer of the dialog. Returns why it could not be shown, or not be used; empty = no error.
  [[nodiscard]] std::string poll();

 private:
  class Bus;
  const std::unique_ptr<Bus> bus_;
  std::function<void(const std::string& path)> chosen_;  // null = no dialog is open
  std::jthread thread_;
};

}  // namespace saccade
