#pragma once

#include <array>
#include <functional>
#include <string>

#include "ui/panels/view_context.hpp"

namespace saccade {

/// Saves and loads settings as TOML; asks before it replaces a file.
class SettingsDialog {
 public:
  void show();
  void draw(ViewContext& view);

 private:
  void draw_contents(ViewContext& view);
  void draw_desktop_dialogs(ViewContext& view);
  void attempt(const std::function<void()>& what);
  void save(ViewContext& view);
  void write(ViewContext& view);
  void load(ViewContext& view);

  bool opening_ = false, open_ = false, done_ = false;
  std::array<char, 4096> path_{};
  std::string error_;
  std::string replaces_;  // the existing file that the next click replaces; empty = none
};

}  // namespace saccade
