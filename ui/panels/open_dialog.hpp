#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>

#include "ui/panels/view_context.hpp"
#include "ui/session/folder_listing.hpp"

namespace saccade {

/// Chooses a source: a path, a connected sensor, a recent one, an example, or one in a folder; files and
/// folders also by the dialogs of the desktop, where it has some.
class OpenDialog {
 public:
  /// `wake` is called on any thread when there is something new to draw.
  explicit OpenDialog(std::function<void()> wake) : lister_(std::move(wake)) {}
  void show();
  /// Closes it, if it is open, with the next draw().
  void close() { closing_ = true; }
  void draw(ViewContext& view);

 private:
  void draw_contents(ViewContext& view);
  void draw_desktop_dialogs(ViewContext& view);
  void draw_places(ViewContext& view, std::string& chosen);
  void draw_folder(ViewContext& view, std::string& chosen);

  bool opening_ = false, closing_ = false, focus_ = false;
  std::array<char, 4096> text_{};  // as long as a path may be
  FolderLister lister_;
  FolderContents contents_;
};

/// What can be typed, from forms with ", " between them, in lines of at most `width` pixels that break
/// between forms only.
[[nodiscard]] std::string forms_text(const std::string& forms, float width);

}  // namespace saccade
