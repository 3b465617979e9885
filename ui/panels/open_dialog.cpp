#include "ui/panels/open_dialog.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "scene/scene.hpp"
#include "sources/open_source.hpp"
#include "ui/panels/widgets.hpp"
#include "ui/session/typed_path.hpp"

namespace saccade {
namespace {

std::string with_slash(const std::string& folder) { return folder.ends_with('/') ? folder : folder + "/"; }

// A row of a list; `dim` stands behind the name, and a longer text in the tool tip.
bool row(ViewContext& view, const std::string& name, const std::string& dim, const std::string& tip) {
  ImGui::PushID(tip.c_str());
  const bool chosen = ImGui::Selectable("##row", false, ImGuiSelectableFlags_DontClosePopups);
  log_place(view, ("open " + name).c_str());
  explain(tip);
  ImGui::SameLine(0, 0);
  clipped_text(name, ImGui::GetContentRegionAvail().x);
  if (!dim.empty()) {
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, view.colours->dim_text);
    clipped_text(dim, ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
  }
  ImGui::PopID();
  return chosen;
}

void heading(const char* text) {
  ImGui::Spacing();
  ImGui::TextDisabled("%s", text);
}

}  // namespace

std::string forms_text(const std::string& forms, float width) {
  std::string text = "A path, or:", line = text;
  for (std::size_t begin = 0; begin < forms.size();) {
    const std::size_t end = std::min(forms.find(", ", begin), forms.size());
    const std::string form = " " + forms.substr(begin, end - begin) + (end < forms.size() ? "," : "");
    const bool fits = ImGui::CalcTextSize((line + form).c_str()).x <= width;
    if (fits) {
      line += form;
      text += form;
    } else {
      line = form.substr(1);
      text.append("\n").append(line);
    }
    begin = end + 2;
  }
  return text;
}

void OpenDialog::show() {
  opening_ = focus_ = true;
  // Where the last choice was made, without a name that may be wrong.
  set_text(text_, with_slash(contents_.folder.empty() ? "." : contents_.folder));
}

void OpenDialog::draw(ViewContext& view) {
  const bool closes = std::exchange(closing_, false);
  if (!begin_dialog(view, "Open a source", opening_, 860)) return;
  closes ? ImGui::CloseCurrentPopup() : draw_contents(view);
  ImGui::EndPopup();
}

void OpenDialog::draw_contents(ViewContext& view) {
  contents_ = lister_.poll(typed_path(text_.data()));
  std::string chosen;
  ImGui::TextDisabled("%s", forms_text(source_forms(), ImGui::GetContentRegionAvail().x).c_str());
  if (std::exchange(focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-view.px(80));
  if (ImGui::InputText("##uri", text_.data(), text_.size(), ImGuiInputTextFlags_EnterReturnsTrue))
    chosen = text_.data();
  ImGui::SameLine();
  if (ImGui::Button("Open", {-1, 0})) chosen = text_.data();
  explain("Opens the source that is named at the left");
  draw_desktop_dialogs(view);
  const float height = std::min(view.px(340), ImGui::GetIO().DisplaySize.y * 0.5F);
  ImGui::BeginChild("places", {ImGui::GetContentRegionAvail().x * 0.42F, height});
  draw_places(view, chosen);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("folder", {0, height});
  draw_folder(view, chosen);
  ImGui::EndChild();
  chosen = typed_path(chosen);
  if (chosen.empty()) return;
  view.open(chosen.ends_with('/') && chosen.size() > 1 ? chosen.substr(0, chosen.size() - 1) : chosen);
  ImGui::CloseCurrentPopup();
}

void OpenDialog::draw_desktop_dialogs(ViewContext& view) {
  if (!view.file_dialog) return;
  const auto ask = [&](FileDialog::Kind kind, const char* title) {
    view.file_dialog({kind, title, contents_.folder, "", ""}, [this, &view](const std::string& path) {
      view.open(path);
      close();
    });
  };
  if (ImGui::Button("Choose a file…"))
    ask(FileDialog::Kind::open_file, "Open a recording, an image or a video");
  log_place(view, "choose a file");
  explain("By the desktop's own dialog");
  ImGui::SameLine();
  if (ImGui::Button("Choose a folder…")) ask(FileDialog::Kind::open_folder, "Open a folder of images");
  log_place(view, "choose a folder");
  explain("By the desktop's own dialog");
}

// Everything that can be opened without a path.
void OpenDialog::draw_places(ViewContext& view, std::string& chosen) {
  heading("Sensors");
  if (!view.sensors.error.empty())
    wrapped_text(view.sensors.error, Tone::bad);
  else if (!view.sensors.devices)
    ImGui::TextDisabled("looking for sensors …");
  else if (view.sensors.devices->empty())
    ImGui::TextDisabled("none is connected");
  if (view.sensors.devices)
    for (const DeviceChoice& device : *view.sensors.devices)
      if (row(view, device.name, device.detail, device.source)) chosen = device.source;
  if (!view.state.recent.empty()) heading("Recent");
  for (const std::string& uri : view.state.recent) {
    const std::string name = short_name(uri);
    const bool path = name.size() < uri.size();
    if (row(view, name, path ? uri.substr(0, uri.size() - name.size()) : "", uri)) chosen = uri;
  }
  heading("Examples");
  if (!view.example.empty() && row(view, short_name(view.example), "the bundled recording", view.example))
    chosen = view.example;
  for (const std::string_view scene : scene::scene_names()) {
    const std::string uri = "synthetic:" + std::string(scene);
    if (row(view, uri, "a computed scene", uri)) chosen = uri;
  }
}

void OpenDialog::draw_folder(ViewContext& view, std::string& chosen) {
  ImGui::Spacing();  // as the headings beside it
  wrapped_text(contents_.folder, Tone::quiet);
  if (!contents_.error.empty()) wrapped_text(contents_.error, Tone::bad);
  if (contents_.source) {
    if (ImGui::Button("Open this folder")) chosen = contents_.folder;
    log_place(view, "open this folder");
    explain("Plays the images of this folder");
  }
  if (!contents_.parent.empty() && row(view, "..", "", "The folder above"))
    set_text(text_, with_slash(contents_.parent));
  for (const FolderContents::Entry& entry : contents_.entries) {
    const std::string path = with_slash(contents_.folder) + entry.name;
    if (!entry.folder) {
      if (row(view, entry.name, "", path)) chosen = path;
      continue;
    }
    if (row(view, entry.name + "/", entry.source ? "a source: enter it to open it" : "", path))
      set_text(text_, path + "/");
  }
  if (contents_.more)
    wrapped_text(fmt::format("Only the first {} are listed.", FolderContents::kMostEntries), Tone::quiet);
  if (contents_.entries.empty() && contents_.error.empty())
    wrapped_text("Nothing here can be opened.", Tone::quiet);
}

}  // namespace saccade
