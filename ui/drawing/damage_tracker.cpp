#include "ui/drawing/damage_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

namespace saccade {
namespace {

std::string_view owner_of(const ImDrawList& list) {
  return list._OwnerName != nullptr ? list._OwnerName : "";
}

cv::Rect2f rect_of(const ImVec4& clip) { return {cv::Point2f(clip.x, clip.y), cv::Point2f(clip.z, clip.w)}; }

// An empty rectangle adds nothing.
void extend(cv::Rect2f& box, const cv::Rect2f& by) {
  if (!by.empty()) box = box.empty() ? by : box | by;
}

// Rectangles that overlap become one, until none do.
void unite(std::vector<cv::Rect>& rects) {
  for (std::size_t i = 0; i < rects.size(); ++i)
    for (std::size_t j = i + 1; j < rects.size(); ++j)
      if (!(rects[i] & rects[j]).empty()) {
        rects[i] |= rects[j];
        rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(j));
        i = static_cast<std::size_t>(-1);  // the larger one may reach others: from the beginning
        break;
      }
}

}  // namespace

bool DamageTracker::Triangle::operator==(const Triangle& other) const {
  // The same bits draw the same pixels.
  const auto same_bits = [](const auto& a, const auto& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;  // NOLINT(bugprone-suspicious-memory-comparison)
  };
  return texture == other.texture && same_bits(corners, other.corners) && same_bits(clip, other.clip);
}

void DamageTracker::flatten(const ImDrawList& list, List& out) {
  out.owner = owner_of(list);
  out.triangles.clear();
  out.reach = {};
  for (const ImDrawCmd& command : list.CmdBuffer) {
    if (command.UserCallback != nullptr) extend(out.reach, rect_of(command.ClipRect));
    const auto at = [&](unsigned i) {
      return list.VtxBuffer[static_cast<int>(command.VtxOffset) +
                            list.IdxBuffer[static_cast<int>(command.IdxOffset + i)]];
    };
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3)
      out.triangles.push_back({{at(i), at(i + 1), at(i + 2)}, command.ClipRect, command.TextureId});
  }
}

// ImGui's windows, in the order in which they cover each other.
bool DamageTracker::same_windows(std::span<ImDrawList* const> lists) const {
  return std::equal(lists.begin(), lists.end(), lists_.begin(), lists_.end(),
                    [](const ImDrawList* list, const List& old) { return owner_of(*list) == old.owner; });
}

void DamageTracker::add(std::span<const Triangle> triangles) {
  cv::Rect2f box;
  for (const Triangle& t : triangles) {
    const auto [left, right] = std::minmax({t.corners[0].pos.x, t.corners[1].pos.x, t.corners[2].pos.x});
    const auto [top, bottom] = std::minmax({t.corners[0].pos.y, t.corners[1].pos.y, t.corners[2].pos.y});
    extend(box, cv::Rect2f(cv::Point2f(left, top), cv::Point2f(right, bottom)) & rect_of(t.clip));
  }
  if (!box.empty()) damage_.push_back(box);
}

// Damaged is what lies between the first and the last triangle that differ, before and after.
void DamageTracker::compare(const List& before, const List& after, std::span<const TextureId> renewed) {
  for (const cv::Rect2f& reach : {before.reach, after.reach})
    if (!reach.empty()) damage_.push_back(reach);
  for (const Triangle& triangle : after.triangles)
    if (std::find(renewed.begin(), renewed.end(), reinterpret_cast<TextureId>(triangle.texture)) !=
        renewed.end())
      add({&triangle, 1});
  const std::span<const Triangle> old = before.triangles, now = after.triangles;
  const std::size_t shorter = std::min(old.size(), now.size());
  std::size_t first = 0, last = 0;
  while (first < shorter && old[first] == now[first]) ++first;
  while (last < shorter - first && old[old.size() - 1 - last] == now[now.size() - 1 - last]) ++last;
  add(old.subspan(first, old.size() - first - last));
  add(now.subspan(first, now.size() - first - last));
}

std::vector<cv::Rect> DamageTracker::damage(const ImDrawData& data, std::span<const TextureId> renewed) {
  const cv::Size size(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                      static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
  const std::span<ImDrawList* const> lists(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount));
  const bool all = std::exchange(size_, size) != size || !same_windows(lists);
  lists_.resize(lists.size());
  damage_.clear();
  for (std::size_t i = 0; i < lists.size(); ++i) {
    flatten(*lists[i], next_);
    if (!all) compare(lists_[i], next_, renewed);
    std::swap(lists_[i], next_);
  }
  if (all) return {cv::Rect({}, size)};
  return in_pixels(data);
}

std::vector<cv::Rect> DamageTracker::in_pixels(const ImDrawData& data) const {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  std::vector<cv::Rect> pixels;
  for (const cv::Rect2f& r : damage_) {
    // A pixel more on each side: edges are smoothed.
    const cv::Point low(static_cast<int>(std::floor((r.x - origin.x) * scale.x)) - 1,
                        static_cast<int>(std::floor((r.y - origin.y) * scale.y)) - 1);
    const cv::Point high(static_cast<int>(std::ceil((r.x + r.width - origin.x) * scale.x)) + 1,
                         static_cast<int>(std::ceil((r.y + r.height - origin.y) * scale.y)) + 1);
    if (const cv::Rect box = cv::Rect(low, high) & cv::Rect({}, size_); !box.empty()) pixels.push_back(box);
  }
  unite(pixels);
  return pixels;
}

}  // namespace saccade
