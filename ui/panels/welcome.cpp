#include <algorithm>

#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {

void draw_welcome(ViewContext& view, ImVec2 low, ImVec2 high) {
  if (!view.welcome) return;
  const float width = std::min(view.px(430), high.x - low.x - view.px(24));
  ImGui::SetNextWindowPos({low.x + view.px(12), low.y + view.px(44)});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view.px(16), view.px(12)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, view.px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view.px(8), view.px(9)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, as_vec4((view.colours->panel & 0x00ffffff) | 0xf4000000));
  ImGui::Begin("##welcome", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushFont(view.fonts.bold);
  ImGui::TextUnformatted("Welcome to Saccade");
  ImGui::PopFont();
  wrapped_text(
      "This is a demo recording: a table with objects. The colours show where the scene is symmetric, which "
      "attracts attention; each object that an observer would look at has a number, and the ring is around "
      "the one that is looked at now.");
  if (ImGui::Button("Open a sensor, a file or an example…")) view.act(Action::open_source);
  explain(with_key("Lists connected sensors, recent sources, examples and folders", Action::open_source));
  log_place(view, "welcome open");
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize("Help").x + 2 * ImGui::GetStyle().FramePadding.x)
    ImGui::NewLine();
  if (ImGui::Button("Help")) view.act(Action::show_help);
  explain(with_key("Keys, mouse, what the colours mean, and a glossary", Action::show_help));
  log_place(view, "welcome help");
  ImGui::Checkbox("Show this at the start", &view.state.welcome);
  explain("This card appears when the viewer is started without a SOURCE");
  ImGui::SameLine();
  if (ImGui::Button("Close")) view.welcome = false;
  explain("Hides this card; Help has more");
  log_place(view, "welcome close");
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

}  // namespace saccade
