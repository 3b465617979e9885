#include "ui/panels/settings_dialog.hpp"

#include <exception>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "core/file.hpp"
#include "ui/panels/widgets.hpp"
#include "ui/session/typed_path.hpp"

namespace saccade {
namespace fs = std::filesystem;

void SettingsDialog::show() {
  opening_ = true;
  done_ = false;
  error_.clear();
  replaces_.clear();
  if (path_[0] != '\0') return;
  std::error_code code;
  set_text(path_, (fs::current_path(code) / "saccade.toml").string());
}

void SettingsDialog::draw(ViewContext& view) {
  open_ = begin_dialog(view, "Settings file", opening_, 560);
  if (!open_) return;
  draw_contents(view);
  if (std::exchange(done_, false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void SettingsDialog::draw_contents(ViewContext& view) {
  ImGui::TextDisabled("A TOML file, which saccade run --config reads too");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##path", path_.data(), path_.size());
  explain("The path of the file; ~ is the home folder");
  if (replaces_ != typed_path(path_.data())) replaces_.clear();
  if (ImGui::Button(replaces_.empty() ? "Save###save" : "Replace it###save")) save(view);
  log_place(view, "save settings");
  explain("Writes the settings that differ from the default; asks before it replaces a file");
  ImGui::SameLine();
  if (ImGui::Button("Load")) load(view);
  explain("Reads the settings of the file; those that it does not name get their defaults");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) done_ = true;
  explain("Closes this without saving or loading (Esc)");
  draw_desktop_dialogs(view);
  if (!replaces_.empty()) wrapped_text("This file exists already.", Tone::warning);
  if (!error_.empty()) wrapped_text(error_, Tone::bad);
}

void SettingsDialog::draw_desktop_dialogs(ViewContext& view) {
  if (!view.file_dialog) return;
  const fs::path path = typed_path(path_.data());
  const auto ask = [&](FileDialog::Kind kind, const char* title, void (SettingsDialog::*then)(ViewContext&)) {
    const bool saves = kind == FileDialog::Kind::save_file;
    view.file_dialog({kind, title, path.parent_path().string(), saves ? path.filename().string() : "", ""},
                     [this, &view, then](const std::string& chosen) {
                       set_text(path_, chosen);
                       (this->*then)(view);
                       if (!open_ && !error_.empty()) view.report(error_);
                     });
  };
  if (ImGui::Button("Save as…"))
    ask(FileDialog::Kind::save_file, "Save the settings", &SettingsDialog::write);
  log_place(view, "save settings as");
  explain("Saves to a file that is chosen by the desktop's own dialog");
  ImGui::SameLine();
  if (ImGui::Button("Load from…")) ask(FileDialog::Kind::open_file, "Load settings", &SettingsDialog::load);
  log_place(view, "load settings from");
  explain("Loads a file that is chosen by the desktop's own dialog");
}

void SettingsDialog::attempt(const std::function<void()>& what) {
  try {
    what();
    error_.clear();
    done_ = true;
  } catch (const std::exception& error) {
    error_ = error.what();
  }
}

void SettingsDialog::save(ViewContext& view) {
  std::error_code code;
  const std::string path = typed_path(path_.data());
  if (replaces_.empty() && fs::exists(path, code)) {
    replaces_ = path;
    return;
  }
  write(view);
}

void SettingsDialog::write(ViewContext& view) {
  attempt([&] {
    const std::string path = typed_path(path_.data());
    write_file(path, std::string_view(settings_toml(view.state.edited())));
    view.notify("Saved " + path);
  });
}

void SettingsDialog::load(ViewContext& view) {
  attempt([&] {
    const bool into_b = view.state.comparing() && view.state.edit_b;
    const std::string path = typed_path(path_.data());
    const std::vector<std::string> left = load_compared(view.state.settings, into_b, path);
    view.notify(fmt::format(
        "Loaded {}{}{}", path,
        left.empty() ? "" : "; ignored here, since they are for the command line: ", fmt::join(left, ", ")));
  });
}

}  // namespace saccade
