#include <algorithm>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "sources/open_source.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostEntries = 500;  // of a folder, in the list

void set_text(char* text, std::size_t size, const std::string& value) {
  std::strncpy(text, value.c_str(), size - 1);
  text[size - 1] = '\0';
}

bool begin_dialog(ViewContext& view, const char* title, bool& opening, double width) {
  if (opening) ImGui::OpenPopup(title);
  opening = false;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(view.px(width), size.x * 0.96F), 0});
  bool stays = true;
  return ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
}

void close_on_escape() {
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
}

struct Entry {
  std::string name;
  bool folder = false;
};

// The folders in a folder, and the files that look like a source, by name.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code code;
  for (fs::directory_iterator i(folder, code), end; !code && i != end && entries.size() < kMostEntries;
       i.increment(code)) {
    const std::string name = i->path().filename().string();
    std::error_code kind;
    const bool is_folder = i->is_directory(kind);
    if (!name.starts_with('.') && (is_folder || has_source_ending(i->path())))
      entries.push_back({name, is_folder});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.folder != b.folder ? a.folder : a.name < b.name; });
  return entries;
}

}  // namespace

void OpenDialog::show() { opening_ = focus_ = true; }

void OpenDialog::draw(ViewContext& view) {
  if (opening_ && text_[0] == '\0') set_text(text_, sizeof text_, fs::current_path().string() + "/");
  if (!begin_dialog(view, "Open a source", opening_, 620)) return;
  std::string chosen;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", source_forms().c_str());
  ImGui::PopTextWrapPos();
  if (std::exchange(focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-view.px(80));
  if (ImGui::InputText("##uri", text_, sizeof text_, ImGuiInputTextFlags_EnterReturnsTrue)) chosen = text_;
  ImGui::SameLine();
  if (ImGui::Button("Open", {-1, 0})) chosen = text_;

  ImGui::BeginChild("list", {0, view.px(300)}, false);
  if (!view.state.recent.empty()) ImGui::TextDisabled("Recent");
  for (const std::string& uri : view.state.recent)
    if (ImGui::Selectable(uri.c_str())) chosen = uri;
  const fs::path typed(text_);
  const fs::path folder = fs::is_directory(typed) ? typed : typed.parent_path();
  std::error_code code;
  if (fs::is_directory(folder, code)) {
    ImGui::Spacing();
    ImGui::TextDisabled("%s", folder.c_str());
    if (ImGui::Selectable("..", false, ImGuiSelectableFlags_DontClosePopups)) {
      const fs::path up = fs::weakly_canonical(folder, code).parent_path();
      set_text(text_, sizeof text_, up == up.root_path() ? up.string() : up.string() + "/");
    }
    for (const Entry& entry : entries_of(folder)) {
      const std::string path = (folder / entry.name).string();
      if (!ImGui::Selectable((entry.name + (entry.folder ? "/" : "")).c_str(), false,
                             ImGuiSelectableFlags_DontClosePopups))
        continue;
      set_text(text_, sizeof text_, entry.folder ? path + "/" : path);
      if (!entry.folder) chosen = path;
    }
  }
  ImGui::EndChild();
  if (!chosen.empty()) {
    view.open(chosen.ends_with('/') && chosen.size() > 1 ? chosen.substr(0, chosen.size() - 1) : chosen);
    ImGui::CloseCurrentPopup();
  }
  close_on_escape();
  ImGui::EndPopup();
}

void SettingsDialog::show() {
  opening_ = true;
  error_.clear();
}

void SettingsDialog::draw(ViewContext& view) {
  if (opening_ && path_[0] == '\0')
    set_text(path_, sizeof path_, (fs::current_path() / "saccade.toml").string());
  if (!begin_dialog(view, "Settings file", opening_, 560)) return;
  ImGui::TextDisabled("A TOML file, which saccade run --config reads too");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##path", path_, sizeof path_);
  const auto attempt = [&](const auto& what) {
    try {
      what();
      ImGui::CloseCurrentPopup();
    } catch (const Error& error) {
      error_ = error.what();
    }
  };
  if (ImGui::Button("Save"))
    attempt([&] {
      write_file(path_, std::string_view(settings_toml(view.state.edited())));
      view.notify(std::string("Saved ") + path_);
    });
  explain("Writes the settings that differ from the default; replaces an existing file");
  ImGui::SameLine();
  if (ImGui::Button("Load"))
    attempt([&] {
      const bool into_b = view.state.comparing() && view.state.edit_b;
      const std::vector<std::string> left = load_compared(view.state.settings, into_b, path_);
      view.notify(fmt::format("Loaded {}{}{}", path_,
                              left.empty() ? "" : "; ignored here, since they are for the command line: ",
                              fmt::join(left, ", ")));
    });
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
  if (!error_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, as_vec4(view.colours->error));
    ImGui::TextWrapped("%s", error_.c_str());
    ImGui::PopStyleColor();
  }
  close_on_escape();
  ImGui::EndPopup();
}

}  // namespace saccade
