#include "ui/panels/probe_drawing.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

using reference::PlaneSymmetry;
using reference::PlaneVerdict;

std::string vector_text(const cv::Vec3d& v, int digits) {
  return fmt::format("{:.{}f}  {:.{}f}  {:.{}f}", v[0], digits, v[1], digits, v[2], digits);
}

void draw_pixel(const ProbeShown& shown) {
  if (!begin_labelled_rows("pixel", "x y z, mm ")) return;
  const Probe& probe = shown.probe;
  labelled_row("pixel", fmt::format("row {}, column {}", probe.row, probe.col), Tone::plain,
               "Of the depth image; rows from the top and columns from the left, from 0.");
  if (probe.depth_mm > 0) {
    labelled_row("depth", fmt::format("{:.1f} mm", probe.depth_mm), Tone::plain,
                 "Along the camera's axis, not the distance from the camera.");
    labelled_row("x y z, mm", vector_text(cv::Vec3d(probe.position_mm), 1), Tone::plain,
                 "The point in space: right of, below and in front of the camera.");
  } else {
    labelled_row("depth", "no reading", Tone::warning);
    labelled_row("x y z, mm", "-");
  }
  labelled_row("normal", probe.normal ? vector_text(*probe.normal, 3) : "none", Tone::plain,
               "Direction of the surface there, of length 1.");
  labelled_row("saliency", fmt::format("{:.4f}", shown.saliency), Tone::plain,
               "The value of the map at this pixel, as in the files.");
  ImGui::EndTable();
}

const PlaneSymmetry* best_plane(const LevelProbe& level) {
  const auto winner = level.winner();
  return winner ? &level.symmetry->planes[*winner] : nullptr;
}

// The result of a level in a word or two.
std::string verdict_of(const LevelProbe& level) {
  if (level.depth_mm == 0) return "no reading";
  if (!level.symmetry) return "no normal";
  if (const auto winner = level.winner()) return fmt::format("plane {}", *winner + 1);
  const auto furthest = std::max_element(level.symmetry->planes.begin(), level.symmetry->planes.end(),
                                         [](const auto& a, const auto& b) { return a.verdict < b.verdict; });
  return std::string(to_string(furthest->verdict));
}

void share_bar(double share, ImU32 colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  const float filled = width * static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (filled > 0)
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + height * 0.15F},
                                              {at.x + filled, at.y + height * 0.85F}, colour);
  ImGui::Dummy({width, height});
}

void draw_level_row(const ProbeShown& shown, std::size_t i, int listed, ProbePanelState& state) {
  const LevelProbe& level = shown.probe.levels[i];
  const ImU32 colour = series_colour(level.level);
  ImGui::TableNextColumn();
  swatch(colour);
  const bool chosen = static_cast<int>(i) == listed;
  const std::string label = fmt::format("{}##level", level.level);
  ImGui::PushID(level.level);
  if (ImGui::Selectable(label.c_str(), chosen,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap))
    state.level = state.level == level.level ? -1 : level.level;
  ImGui::PopID();
  number_cell(fmt::format("{:.4f}", level.contribution));
  ImGui::TableNextColumn();
  share_bar(shown.probe.saliency > 0 ? level.contribution / shown.probe.saliency : 0, colour);
  number_cell(fmt::format("{:.3f}", level.score));
  number_cell(fmt::format("{:.0f}", level.footprint_px.width));
  number_cell(level.footprint_mm > 0 ? fmt::format("{:.0f}", level.footprint_mm) : "-");
}

void draw_levels(const ProbeShown& shown, int listed, ProbePanelState& state) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("levels", 6, kFlags)) return;
  const float em = ImGui::GetFontSize();
  const auto fixed = [em](const char* name, float ems) {
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthFixed, ems * em);
  };
  fixed("level", 2.6F);
  fixed("adds", 3.4F);
  ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthStretch);
  fixed("s", 2.8F);
  fixed("px", 2.4F);
  fixed("mm", 2.6F);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  wrapped_text("level", Tone::quiet);
  explain("The level of the pyramid; each is half the size of the one before.");
  number_cell("adds", Tone::quiet);
  explain("What the level adds to the saliency of this pixel: its map, interpolated here, times its weight.");
  ImGui::TableNextColumn();
  number_cell("s", Tone::quiet);
  explain("The operator's value at the level's nearest pixel, 0 to 4.");
  number_cell("px", Tone::quiet);
  explain("Side of the operator's window, in pixels of the image.");
  number_cell("mm", Tone::quiet);
  explain("The same in millimetres, at the depth of the pixel.");
  for (std::size_t i = 0; i < shown.probe.levels.size(); ++i) draw_level_row(shown, i, listed, state);
  ImGui::EndTable();
}

void draw_plane_rows(const LevelProbe& level) {
  const auto winner = level.winner();
  for (std::size_t i = 0; i < level.symmetry->planes.size(); ++i) {
    const PlaneSymmetry& plane = level.symmetry->planes[i];
    const bool wins = winner == i, scores = plane.verdict == PlaneVerdict::scores;
    const Tone tone = wins ? Tone::good : scores ? Tone::plain : Tone::quiet;
    number_cell(fmt::format("{}", i + 1), tone);
    number_cell(fmt::format("{:.3f}", plane.score), tone);
    const bool measured = plane.verdict > PlaneVerdict::no_direction;
    for (const double value : {plane.omega_1, plane.omega_2})
      number_cell(measured ? fmt::format("{:.2f}", value) : "-", tone);
    for (const double value : {plane.delta_D_mm, plane.delta_d_mm})
      number_cell(measured ? fmt::format("{:.1f}", value) : "-", tone);
  }
}

void draw_planes(const LevelProbe& level) {
  wrapped_text(fmt::format("Level {}, its pixel {}, {}: {}", level.level, level.pixel.y, level.pixel.x,
                           verdict_of(level)),
               Tone::quiet);
  if (!level.symmetry || !ImGui::BeginTable("planes", 6, ImGuiTableFlags_RowBg)) return;
  for (const char* name : {"plane", "score", "w1", "w2", "dD", "dd"}) ImGui::TableSetupColumn(name);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  number_cell("plane", Tone::quiet);
  explain("The candidates for the plane of symmetry; the best one wins.");
  number_cell("score", Tone::quiet);
  explain("How well the two halves of the window mirror each other at the plane, 0 to 4.");
  number_cell("w1", Tone::quiet);
  explain(
      "omega_1, Eq. (8): how perpendicular the halves' common normal is to the line between them, 0 to 1.");
  number_cell("w2", Tone::quiet);
  explain("omega_2, Eq. (12): how strongly the halves' normals turn away from each other, 0 to 4.");
  number_cell("dD mm", Tone::quiet);
  explain("Delta D, Eq. (4): difference of the halves' mean depths.");
  number_cell("dd mm", Tone::quiet);
  explain("Delta d, Eq. (7): difference of the halves' mean distances to the plane.");
  draw_plane_rows(level);
  ImGui::EndTable();
  for (std::size_t i = 0; i < level.symmetry->planes.size(); ++i) {
    const PlaneSymmetry& plane = level.symmetry->planes[i];
    const cv::Vec3d gamma(plane.gamma.x(), plane.gamma.y(), plane.gamma.z());
    wrapped_text(fmt::format("{}: {}; normal {}", i + 1, to_string(plane.verdict), vector_text(gamma, 2)),
                 level.winner() == i ? Tone::good : Tone::quiet);
  }
}

void draw_footprint(ImDrawList& list, const LevelProbe& level, bool listed, const PicturePlace& place) {
  const cv::Rect2d& rect = level.footprint_px;
  // footprint_px has (0,0) at the middle of a pixel.
  const ImVec2 low = place.at(rect.y, rect.x), high = place.at(rect.br().y, rect.br().x);
  const float line = ImGui::GetFontSize() / (listed ? 7.0F : 12.0F);
  list.AddRect(low, high, IM_COL32(0, 0, 0, 140), 0, 0, line + 2);
  list.AddRect(low, high, series_colour(level.level), 0, 0, line);
  const std::string label = level.footprint_mm > 0 ? fmt::format("L{}: {:.0f} px, {:.0f} mm", level.level,
                                                                 rect.width, level.footprint_mm)
                                                   : fmt::format("L{}: {:.0f} px", level.level, rect.width);
  const ImVec2 size = ImGui::CalcTextSize(label.c_str());
  if (high.x - low.x < size.x * 0.6F) return;  // no room; the table has the value
  // At the lower edge, but always visible.
  const float x = std::clamp(low.x, place.clip_min.x, std::max(place.clip_min.x, place.clip_max.x - size.x));
  const float y = std::min(high.y, place.clip_max.y) - size.y - line;
  list.AddRectFilled({x, y}, {x + size.x + 2 * line, y + size.y}, IM_COL32(0, 0, 0, 150));
  list.AddText({x + line, y}, series_colour(level.level), label.c_str());
}

void draw_plane_line(ImDrawList& list, const ProbeShown& shown, const LevelProbe& level,
                     const PicturePlace& place) {
  const PlaneSymmetry* plane = best_plane(level);
  if (plane == nullptr || !shown.probe.normal) return;
  const auto trace = plane_trace({plane->gamma.x(), plane->gamma.y(), plane->gamma.z()}, *shown.probe.normal,
                                 shown.probe.position_mm, level.footprint_mm, shown.camera);
  if (!trace) return;
  const ImVec2 a = place.at(trace->first.y, trace->first.x), b = place.at(trace->second.y, trace->second.x);
  const float line = ImGui::GetFontSize() / 7;
  list.AddLine(a, b, IM_COL32(0, 0, 0, 160), line + 2);
  list.AddLine(a, b, IM_COL32(255, 255, 255, 255), line);
}

}  // namespace

int listed_level(const Probe& probe, const ProbePanelState& state) {
  const auto& levels = probe.levels;
  if (levels.empty()) return -1;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (levels[i].level == state.level) return static_cast<int>(i);
  return static_cast<int>(
      std::max_element(levels.begin(), levels.end(),
                       [](const auto& a, const auto& b) { return a.contribution < b.contribution; }) -
      levels.begin());
}

std::optional<std::pair<cv::Point2d, cv::Point2d>> plane_trace(const cv::Vec3d& gamma,
                                                               const cv::Vec3d& surface,
                                                               const cv::Point3d& point_mm, double length_mm,
                                                               const Intrinsics& camera) {
  const cv::Vec3d along = gamma.cross(surface);
  const double length = cv::norm(along);
  if (length < 1e-3) return std::nullopt;
  const cv::Vec3d step = along * (length_mm / 2 / length);
  const cv::Point3d a = point_mm + cv::Point3d(step), b = point_mm - cv::Point3d(step);
  if (a.z <= 0 || b.z <= 0) return std::nullopt;
  const auto pixel = [&](const cv::Point3d& p) {
    return cv::Point2d(camera.cx + camera.fx * p.x / p.z, camera.cy + camera.fy * p.y / p.z);
  };
  return std::pair(pixel(a), pixel(b));
}

void draw_probe(const std::optional<ProbeShown>& shown, ProbePanelState& state) {
  if (!shown) {
    wrapped_text("Point at the picture to see what the operator computes there.", Tone::quiet);
    return;
  }
  draw_pixel(*shown);
  const int listed = listed_level(shown->probe, state);
  if (listed < 0) return;
  ImGui::Spacing();
  if (!shown->levels_apply)
    wrapped_text(fmt::format("The map is of model {}; these are the values of symmetry3d:", shown->model),
                 Tone::warning);
  draw_levels(*shown, listed, state);
  if (shown->levels_apply)
    wrapped_text(fmt::format("sum of the levels: {:.4f}", shown->probe.saliency), Tone::quiet);
  ImGui::Spacing();
  draw_planes(shown->probe.levels[static_cast<std::size_t>(listed)]);
}

void draw_footprints(ImDrawList& list, const ProbeShown& shown, const ProbePanelState& state,
                     const PicturePlace& place) {
  list.PushClipRect(place.clip_min, place.clip_max, true);
  const int listed = listed_level(shown.probe, state);
  for (std::size_t i = shown.probe.levels.size(); i-- > 0;)
    draw_footprint(list, shown.probe.levels[i], static_cast<int>(i) == listed, place);
  if (listed >= 0) draw_plane_line(list, shown, shown.probe.levels[static_cast<std::size_t>(listed)], place);
  list.PopClipRect();
}

}  // namespace saccade
