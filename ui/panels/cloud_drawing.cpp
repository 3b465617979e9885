#include "ui/panels/cloud_drawing.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

constexpr std::array<const char*, 3> kColourNames = {"image", "depth", "saliency"};

// Puts the next item on the same line if there is room for its text, else on a new line.
void continue_line(const char* text, float ems_beside_text) {
  ImGui::SameLine();
  const float needed = ImGui::CalcTextSize(text).x + ems_beside_text * ImGui::GetFontSize();
  if (ImGui::GetContentRegionAvail().x < needed) ImGui::NewLine();
}

void checkbox(const char* label, bool& value, const char* what) {
  continue_line(label, 2.5F);
  ImGui::Checkbox(label, &value);
  explain(what);
}

void draw_choices(CloudStyle& style, CloudPanelState& state) {
  const float em = ImGui::GetFontSize();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + em / 2);
  ImGui::Indent(em / 2);
  ImGui::SetNextItemWidth(7 * em);
  int colour = static_cast<int>(style.colour);
  if (ImGui::Combo("##colour", &colour, kColourNames.data(), static_cast<int>(kColourNames.size())))
    style.colour = static_cast<CloudColour>(colour);
  explain("Colour of the points.");
  checkbox("Lit", style.lit, "Shades the points: surfaces that turn away from the eye are darker.");
  checkbox("Normals", style.needles, "Lines along the surface normals.");
  checkbox("Fixations", style.fixations, "Numbered markers with their positions in mm.");
  continue_line("", 7.5F);
  ImGui::SetNextItemWidth(7 * em);
  ImGui::SliderFloat("##size", &style.point_size, kSmallestPoint, kLargestPoint, "Points ×%.1f",
                     ImGuiSliderFlags_AlwaysClamp);
  explain("Size of the points; 1 = the size of a pixel at their depth.");
  continue_line("Reset view", 1);
  if (ImGui::Button("Reset view")) state.placed = false;
  explain("Back to the sensor's own view; a double click does the same.");
  ImGui::Unindent(em / 2);
}

// Applies the pointer to the last item, which shows the cloud.
void turn_by_pointer(CloudPanelState& state, ImVec2 corner, cv::Size viewport) {
  const ImGuiIO& io = ImGui::GetIO();
  const cv::Point2d drag(static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y));
  if (ImGui::IsItemActive() && drag != cv::Point2d()) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift)
      state.camera.orbit(drag, viewport);
    else
      state.camera.pan(drag, viewport);
  }
  if (!ImGui::IsItemHovered()) return;
  const cv::Point2d pointer(static_cast<double>(io.MousePos.x - corner.x),
                            static_cast<double>(io.MousePos.y - corner.y));
  if (io.MouseWheel != 0) state.camera.zoom(static_cast<double>(io.MouseWheel), pointer, viewport);
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) state.placed = false;
}

struct Box {
  ImVec2 low, high;
  bool meets(const Box& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
};

// A number in a disc, with the position beside it if that covers no other text.
void draw_marker(ImDrawList& list, ImVec2 at, std::size_t rank, const Fixation& fixation,
                 std::vector<Box>& taken) {
  const float em = ImGui::GetFontSize(), radius = 0.75F * em;
  const ImU32 colour = is_doubtful(fixation) ? IM_COL32(255, 255, 255, 110)
                       : rank == 1           ? IM_COL32(80, 255, 80, 255)
                                             : IM_COL32(255, 255, 255, 255);
  list.AddCircleFilled(at, radius, IM_COL32(0, 0, 0, 220));
  list.AddCircle(at, radius, colour, 0, em / 10);
  const std::string number = fmt::format("{}", rank);
  const ImVec2 digits = ImGui::CalcTextSize(number.c_str());
  list.AddText({at.x - digits.x / 2, at.y - digits.y / 2}, colour, number.c_str());

  const cv::Point3f& p = fixation.position_mm;
  const std::string text = fmt::format("{:.0f} {:.0f} {:.0f} mm", p.x, p.y, p.z);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  // At the right; at the left where there is no room.
  const float right = at.x + radius + 0.3F * em;
  const bool fits = right + size.x < list.GetClipRectMax().x;
  const ImVec2 corner(fits ? right : at.x - radius - 0.3F * em - size.x, at.y - size.y / 2);
  const Box box{{corner.x - 0.2F * em, corner.y}, {corner.x + size.x + 0.2F * em, corner.y + size.y}};
  if (std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return box.meets(other); })) return;
  taken.push_back(box);
  list.AddRectFilled(box.low, box.high, IM_COL32(0, 0, 0, 170), 0.2F * em);
  list.AddText(corner, colour, text.c_str());
}

void draw_fixations(const CloudPanelState& state, const std::vector<Fixation>& fixations, ImVec2 corner,
                    cv::Size viewport) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  struct Marker {
    ImVec2 at;
    std::size_t index;
  };
  std::vector<Marker> markers;
  std::vector<Box> taken;  // begins with the discs: no text over them
  const float radius = 0.75F * ImGui::GetFontSize();
  for (std::size_t i = 0; i < fixations.size(); ++i) {
    const cv::Point3f& p = fixations[i].position_mm;
    if (p.z <= 0) continue;  // no reading there
    const auto at = state.camera.project(p, viewport);
    if (!at) continue;
    const ImVec2 screen(corner.x + static_cast<float>(at->x), corner.y + static_cast<float>(at->y));
    markers.push_back({screen, i});
    taken.push_back({{screen.x - radius, screen.y - radius}, {screen.x + radius, screen.y + radius}});
  }
  for (const Marker& marker : markers)
    draw_marker(list, marker.at, marker.index + 1, fixations[marker.index], taken);
}

}  // namespace

OrbitCamera camera_for_frame(const Frame& frame) {
  const auto range = percentile_range(frame.depth_mm, 4);
  const double target_mm =
      range ? (static_cast<double>(range->low) + static_cast<double>(range->high)) / 2 : 1000;
  return OrbitCamera::at_sensor(frame.intrinsics, frame.size(), target_mm);
}

void draw_cloud(CloudStyle& style, CloudPanelState& state, const Frame& frame, const Attention& attention,
                const std::function<ImTextureID(cv::Size)>& render) {
  draw_choices(style, state);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoScrollbar;
  if (ImGui::BeginChild("points", {0, 0}, false, kFlags)) {
    if (!state.placed) state.camera = camera_for_frame(frame);
    state.placed = true;
    const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const cv::Size viewport(std::max(static_cast<int>(room.x), 1), std::max(static_cast<int>(room.y), 1));
    const ImVec2 size(static_cast<float>(viewport.width), static_cast<float>(viewport.height));
    ImGui::InvisibleButton("turn", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    turn_by_pointer(state, corner, viewport);
    const ImVec2& scale = ImGui::GetIO().DisplayFramebufferScale;
    const ImTextureID texture = render({static_cast<int>(size.x * std::max(scale.x, 1.0F)),
                                        static_cast<int>(size.y * std::max(scale.y, 1.0F))});
    if (texture != ImTextureID())
      ImGui::GetWindowDrawList()->AddImage(texture, corner, {corner.x + size.x, corner.y + size.y}, {0, 1},
                                           {1, 0});
    if (style.fixations) draw_fixations(state, attention.fixations, corner, viewport);
  }
  ImGui::EndChild();
}

}  // namespace saccade
