#include "ui/panels/cloud_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "ui/panels/panel_text.hpp"
#include "ui/session/cloud_pick.hpp"

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
  explain("Colour of the points: the saliency map over the image, the image alone, or depth.");
  checkbox("Lit", style.lit, "Shades the points: surfaces that turn away from the eye are darker.");
  checkbox("Normals", style.needles, "Lines along the surface normals.");
  checkbox("Fixations", style.fixations,
           "Numbered marks with their positions in mm; those behind a surface are faint.");
  continue_line("", 7.5F);
  ImGui::SetNextItemWidth(7 * em);
  ImGui::SliderFloat("##size", &style.point_size, kSmallestPoint, kLargestPoint, "Points ×%.1f",
                     ImGuiSliderFlags_AlwaysClamp);
  explain("Size of the points; 1 = the size of a pixel at their depth.");
  continue_line("Reset view", 1);
  if (ImGui::Button("Reset view")) state.placed = false;
  explain("Back to the sensor's own view; a double click does the same.");
  if (!state.title.empty()) {
    continue_line(state.title.c_str(), 0);
    ImGui::TextDisabled("%s", state.title.c_str());
    state.title_place = place_of_item("cloud title");
  }
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

// The largest of 1, 2, 5, 10, 20, 50, ... that is at most `most`.
double nice_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(std::max(most, 1e-3))));
  for (const double digit : {5, 2})
    if (digit * power <= most) return digit * power;
  return power;
}

struct Marker {
  ImVec2 at;
  std::size_t rank;
  int id;  // over time; 0 = the rank is its number
  cv::Point3f position_mm;
  bool doubtful;  // see is_doubtful()
  bool hidden;    // behind a surface
};

ImU32 marker_colour(const Marker& marker, unsigned opacity) {
  if (marker.doubtful) return IM_COL32(255, 255, 255, opacity);
  if (marker.id == 0)
    return marker.rank == 1 ? IM_COL32(80, 255, 80, opacity) : IM_COL32(255, 255, 255, opacity);
  const cv::Scalar bgr = object_colour(marker.id);
  return IM_COL32(static_cast<int>(bgr[2]), static_cast<int>(bgr[1]), static_cast<int>(bgr[0]), opacity);
}

// A number in a disc, with the position beside it if that covers no other text; faint and without the
// position if it is hidden.
void draw_marker(ImDrawList& list, const Marker& marker, std::vector<Box>& taken) {
  const float em = ImGui::GetFontSize(), radius = 0.75F * em;
  const ImVec2 at = marker.at;
  const unsigned opacity = marker.hidden ? 90 : marker.doubtful ? 110 : 255;
  const ImU32 colour = marker_colour(marker, opacity);
  list.AddCircleFilled(at, radius, IM_COL32(0, 0, 0, marker.hidden ? 70 : 220));
  list.AddCircle(at, radius, colour, 0, em / 10);
  const std::string number = fmt::format("{}", marker.id != 0 ? marker.id : static_cast<int>(marker.rank));
  const ImVec2 digits = ImGui::CalcTextSize(number.c_str());
  list.AddText({at.x - digits.x / 2, at.y - digits.y / 2}, IM_COL32(255, 255, 255, opacity), number.c_str());
  if (marker.hidden) return;

  const std::string text = fmt::format("{:.0f} {:.0f} {:.0f} mm", marker.position_mm.x, marker.position_mm.y,
                                       marker.position_mm.z);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  // At the right; at the left where there is no room. Never cut at the top or the bottom.
  const float right = at.x + radius + 0.3F * em;
  const bool fits = right + size.x < list.GetClipRectMax().x;
  const float y = std::clamp(at.y - size.y / 2, list.GetClipRectMin().y,
                             std::max(list.GetClipRectMin().y, list.GetClipRectMax().y - size.y));
  const ImVec2 corner(fits ? right : at.x - radius - 0.3F * em - size.x, y);
  const Box box{{corner.x - 0.2F * em, corner.y}, {corner.x + size.x + 0.2F * em, corner.y + size.y}};
  if (std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return box.meets(other); })) return;
  taken.push_back(box);
  list.AddRectFilled(box.low, box.high, IM_COL32(0, 0, 0, 170), 0.2F * em);
  list.AddText(corner, colour, text.c_str());
}

// Marks those markers that lie behind the surface: of every eighth row and column of the depth image, a point
// is at the same place of the screen and nearer to the eye.
void find_hidden(const OrbitCamera& camera, const Frame& frame, ImVec2 corner, cv::Size viewport,
                 std::vector<Marker>& markers) {
  constexpr int kEvery = 8;
  constexpr double kInFront_mm = 60;
  constexpr float kNear_px = 8;
  const cv::Point3d eye(camera.eye_mm());
  if (cv::norm(eye) < 1) return;  // from where the sensor sees, nothing hides what it sees
  for (int r = 0; r < frame.depth_mm.rows; r += kEvery)
    for (int c = 0; c < frame.depth_mm.cols; c += kEvery) {
      const auto z = static_cast<double>(frame.depth_mm(r, c));
      if (!(z > 0)) continue;
      const cv::Point3d point = frame.intrinsics.point_mm(r, c, z);
      const auto at = camera.project(point, viewport);
      if (!at) continue;
      for (Marker& marker : markers) {
        const float dx = corner.x + static_cast<float>(at->x) - marker.at.x;
        const float dy = corner.y + static_cast<float>(at->y) - marker.at.y;
        if (std::abs(dx) > kNear_px || std::abs(dy) > kNear_px) continue;
        marker.hidden |=
            cv::norm(point - eye) + kInFront_mm < cv::norm(cv::Point3d(marker.position_mm) - eye);
      }
    }
}

// Returns the index of the one under the pointer; -1 = none.
int draw_fixations(const CloudPanelState& state, const Frame& frame, const std::vector<Fixation>& fixations,
                   ImVec2 corner, cv::Size viewport) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::vector<Marker> markers;
  std::vector<Box> taken;  // begins with the discs: no text over them
  const float radius = 0.75F * ImGui::GetFontSize();
  for (std::size_t i = 0; i < fixations.size(); ++i) {
    const cv::Point3f& p = fixations[i].position_mm;
    if (p.z <= 0) continue;  // no reading there
    const auto at = state.camera.project(p, viewport);
    if (!at) continue;
    const ImVec2 screen(corner.x + static_cast<float>(at->x), corner.y + static_cast<float>(at->y));
    markers.push_back({screen, i + 1, fixations[i].id, p, is_doubtful(fixations[i]), false});
    taken.push_back({{screen.x - radius, screen.y - radius}, {screen.x + radius, screen.y + radius}});
  }
  find_hidden(state.camera, frame, corner, viewport, markers);
  int hovered = -1;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (const Marker& marker : markers) {
    draw_marker(list, marker, taken);
    if (std::hypot(mouse.x - marker.at.x, mouse.y - marker.at.y) <= radius)
      hovered = static_cast<int>(marker.rank) - 1;
    if (static_cast<int>(marker.rank) - 1 == state.highlighted)
      list.AddCircle(marker.at, 1.25F * radius, ImGui::GetColorU32(ImGuiCol_CheckMark), 0, radius / 4);
  }
  return hovered;
}

// A cross at the point of the pinned pixel.
void draw_pin(const CloudPanelState& state, ImVec2 corner, cv::Size viewport) {
  const auto at = state.pinned ? state.camera.project(*state.pinned, viewport) : std::nullopt;
  if (!at) return;
  const float x = corner.x + static_cast<float>(at->x), y = corner.y + static_cast<float>(at->y);
  const float near = 0.25F * ImGui::GetFontSize(), far = 0.75F * ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const auto& [colour, width] :
       {std::pair(IM_COL32(0, 0, 0, 200), 3.5F), {ImGui::GetColorU32(ImGuiCol_CheckMark), 1.5F}})
    for (const float way : {-1.0F, 1.0F}) {
      list.AddLine({x + way * near, y}, {x + way * far, y}, colour, width);
      list.AddLine({x, y + way * near}, {x, y + way * far}, colour, width);
    }
}

// Whether the last item was clicked and not dragged.
bool was_clicked() {
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 from = io.MouseClickedPos[ImGuiMouseButton_Left];
  return ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
         std::hypot(io.MousePos.x - from.x, io.MousePos.y - from.y) < ImGui::GetFontSize() / 4;
}

void draw_measured(const CloudPanelState& state, ImVec2 corner, cv::Size viewport) {
  if (state.measured.size() != 2) return;
  const auto a = state.camera.project(state.measured[0], viewport);
  const auto b = state.camera.project(state.measured[1], viewport);
  if (!a || !b) return;
  const ImVec2 from(corner.x + static_cast<float>(a->x), corner.y + static_cast<float>(a->y));
  const ImVec2 to(corner.x + static_cast<float>(b->x), corner.y + static_cast<float>(b->y));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  list.AddLine(from, to, ImGui::GetColorU32(ImGuiCol_CheckMark), em / 8);
  const std::string text = fmt::format("{:.0f} mm", cv::norm(state.measured[0] - state.measured[1]));
  const ImVec2 middle((from.x + to.x) / 2, (from.y + to.y) / 2), size = ImGui::CalcTextSize(text.c_str());
  list.AddRectFilled(middle, {middle.x + size.x + 0.4F * em, middle.y + size.y}, IM_COL32(0, 0, 0, 190),
                     em / 5);
  list.AddText({middle.x + 0.2F * em, middle.y}, IM_COL32_WHITE, text.c_str());
}

// The axes of the camera frame, and a length at the distance of the target, in the lower left corner.
void draw_axes_and_scale(const OrbitCamera& camera, ImVec2 corner, cv::Size viewport) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize(), arm = 1.8F * em;
  const ImVec2 origin(corner.x + 2.6F * em, corner.y + static_cast<float>(viewport.height) - 3.4F * em);
  const cv::Matx44d view = camera.view();
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  const std::array<ImU32, 3> colours = {IM_COL32(240, 90, 80, 255), IM_COL32(90, 200, 90, 255),
                                        IM_COL32(90, 150, 255, 255)};
  for (int i = 0; i < 3; ++i) {
    const ImVec2 end(origin.x + arm * static_cast<float>(view(0, i)),
                     origin.y - arm * static_cast<float>(view(1, i)));
    const auto k = static_cast<std::size_t>(i);
    list.AddLine(origin, end, colours[k], em / 7);
    list.AddText({end.x + em / 6, end.y - em / 2}, colours[k], kNames[k]);
  }
  const double mm_per_px = camera.distance_mm() / camera.focal_px(viewport);
  const double length = nice_length(6 * static_cast<double>(em) * mm_per_px);
  const float width = static_cast<float>(length / mm_per_px);
  const ImVec2 left(corner.x + 6 * em, corner.y + static_cast<float>(viewport.height) - em);
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
  list.AddLine(left, {left.x + width, left.y}, colour, em / 8);
  for (const float x : {left.x, left.x + width})
    list.AddLine({x, left.y - em / 4}, {x, left.y + em / 4}, colour, em / 8);
  list.AddText({left.x, left.y - 1.4F * em}, colour, fmt::format("{:g} mm", length).c_str());
}

}  // namespace

OrbitCamera camera_for_frame(const Frame& frame) {
  const auto range = percentile_range(frame.depth_mm, 25);
  const double target_mm =
      range ? (static_cast<double>(range->low) + static_cast<double>(range->high)) / 2 : 1000;
  return OrbitCamera::at_sensor(frame.intrinsics, frame.size(), target_mm);
}

void draw_cloud(CloudStyle& style, CloudPanelState& state, const Frame& frame, const Attention& attention,
                const std::function<ImTextureID(cv::Size)>& render) {
  draw_choices(style, state);
  state.hovered_mark = -1;
  state.clicked = false;
  state.clicked_pixel.reset();
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
    const bool hovered = ImGui::IsItemHovered();
    state.clicked = was_clicked();
    const ImVec2& scale = ImGui::GetIO().DisplayFramebufferScale;
    const ImTextureID texture = render({static_cast<int>(size.x * std::max(scale.x, 1.0F)),
                                        static_cast<int>(size.y * std::max(scale.y, 1.0F))});
    if (texture != ImTextureID())
      ImGui::GetWindowDrawList()->AddImage(texture, corner, {corner.x + size.x, corner.y + size.y}, {0, 1},
                                           {1, 0});
    draw_axes_and_scale(state.camera, corner, viewport);
    const int mark =
        style.fixations ? draw_fixations(state, frame, attention.fixations, corner, viewport) : -1;
    if (hovered) state.hovered_mark = mark;
    draw_pin(state, corner, viewport);
    draw_measured(state, corner, viewport);
    if (state.clicked && state.hovered_mark < 0) {
      const ImVec2 mouse = ImGui::GetIO().MousePos;
      state.clicked_pixel =
          pixel_at(state.camera, frame,
                   {static_cast<double>(mouse.x - corner.x), static_cast<double>(mouse.y - corner.y)},
                   viewport, static_cast<double>(ImGui::GetFontSize()) / 3);
    }
  }
  ImGui::EndChild();
}

}  // namespace saccade
