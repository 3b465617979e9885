#include "ui/panels/settings_dialog.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace fs = std::filesystem;

void SettingsDialog::show() {
  opening_ = true;
  error_.clear();
  replaces_.clear();
  if (path_[0] != '\0') return;
  std::error_code code;
  const std::string path = (fs::current_path(code) / "saccade.toml").string();
  std::memcpy(path_.data(), path.data(), std::min(path.size(), path_.size() - 1));
}

void SettingsDialog::draw(ViewContext& view) {
  if (!begin_dialog(view, "Settings file", opening_, 560)) return;
  ImGui::TextDisabled("A TOML file, which saccade run --config reads too");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##path", path_.data(), path_.size());
  if (replaces_ != path_.data()) replaces_.clear();
  if (ImGui::Button(replaces_.empty() ? "Save###save" : "Replace it###save")) save(view);
  log_place(view, "save settings");
  explain("Writes the settings that differ from the default; asks before it replaces a file");
  ImGui::SameLine();
  if (ImGui::Button("Load")) load(view);
  explain("Reads the settings of the file; those that it does not name get their defaults");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
  if (!replaces_.empty()) wrapped_text("This file exists already.", Tone::warning);
  if (!error_.empty()) wrapped_text(error_, Tone::bad);
  ImGui::EndPopup();
}

void SettingsDialog::attempt(const std::function<void()>& what) {
  try {
    what();
    error_.clear();
    ImGui::CloseCurrentPopup();
  } catch (const Error& error) {
    error_ = error.what();
  }
}

void SettingsDialog::save(ViewContext& view) {
  std::error_code code;
  const std::string path = path_.data();
  if (replaces_.empty() && fs::exists(path, code)) {
    replaces_ = path;
    return;
  }
  attempt([&] {
    write_file(path, std::string_view(settings_toml(view.state.edited())));
    view.notify("Saved " + path);
  });
}

void SettingsDialog::load(ViewContext& view) {
  attempt([&] {
    const bool into_b = view.state.comparing() && view.state.edit_b;
    const std::vector<std::string> left = load_compared(view.state.settings, into_b, path_.data());
    view.notify(fmt::format(
        "Loaded {}{}{}", path_.data(),
        left.empty() ? "" : "; ignored here, since they are for the command line: ", fmt::join(left, ", ")));
  });
}

}  // namespace saccade
