#include "ui/drawing/draw_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace saccade {
namespace {

template <typename T>
bool same_bytes(const std::vector<T>& x, const ImVector<T>& y) {
  return x.size() == static_cast<std::size_t>(y.Size) &&
         (x.empty() || std::memcmp(x.data(), y.Data, x.size() * sizeof(T)) == 0);
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

bool DrawMemory::holds(const List& old, const ImDrawList& list) {
  return same_bytes(old.commands, list.CmdBuffer) && same_bytes(old.indices, list.IdxBuffer) &&
         same_bytes(old.vertices, list.VtxBuffer);
}

void DrawMemory::remember(const ImDrawList& list, List& out) {
  out.owner = list._OwnerName != nullptr ? list._OwnerName : "";
  out.commands.assign(list.CmdBuffer.begin(), list.CmdBuffer.end());
  out.indices.assign(list.IdxBuffer.begin(), list.IdxBuffer.end());
  out.vertices.assign(list.VtxBuffer.begin(), list.VtxBuffer.end());
}

void DrawMemory::take_apart(const ImDrawCmd* commands, std::size_t count, const ImDrawIdx* indices,
                            const ImDrawVert* vertices, Pieces& out) {
  out.clear();
  for (const ImDrawCmd& command : std::span(commands, count)) {
    if (command.UserCallback != nullptr) throw std::invalid_argument("DrawMemory: a drawing with a callback");
    const auto at = [&](unsigned i) { return vertices[command.VtxOffset + indices[command.IdxOffset + i]]; };
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3)
      out.push_back({{at(i), at(i + 1), at(i + 2)}, command.ClipRect, command.TextureId});
  }
}

void DrawMemory::add(std::span<const Piece> pieces) {
  cv::Rect2f box;
  for (const Piece& p : pieces) {
    const auto [left, right] = std::minmax({p.corners[0].pos.x, p.corners[1].pos.x, p.corners[2].pos.x});
    const auto [top, bottom] = std::minmax({p.corners[0].pos.y, p.corners[1].pos.y, p.corners[2].pos.y});
    const cv::Rect2f seen = cv::Rect2f(cv::Point2f(left, top), cv::Point2f(right, bottom)) &
                            cv::Rect2f(cv::Point2f(p.clip.x, p.clip.y), cv::Point2f(p.clip.z, p.clip.w));
    if (!seen.empty()) box = box.empty() ? seen : box | seen;
  }
  if (!box.empty()) changed_.push_back(box);
}

bool DrawMemory::same(const Piece& x, const Piece& y) {
  return x.texture == y.texture && std::memcmp(x.corners, y.corners, sizeof x.corners) == 0 &&
         std::memcmp(&x.clip, &y.clip, sizeof x.clip) == 0;
}

// What lies between the first and the last triangle that differ; either list may be missing.
void DrawMemory::compare(const List* old, const ImDrawList* list, std::span<const ImTextureID> renewed) {
  before_.clear();
  after_.clear();
  if (list != nullptr)
    take_apart(list->CmdBuffer.Data, static_cast<std::size_t>(list->CmdBuffer.Size), list->IdxBuffer.Data,
               list->VtxBuffer.Data, after_);
  for (const ImTextureID texture : renewed)
    for (const Piece& piece : after_)
      if (piece.texture == texture) add({&piece, 1});
  if (old != nullptr) {
    if (list != nullptr && holds(*old, *list)) return;
    take_apart(old->commands.data(), old->commands.size(), old->indices.data(), old->vertices.data(),
               before_);
  }
  const std::size_t shorter = std::min(before_.size(), after_.size());
  std::size_t first = 0, last = 0;
  while (first < shorter && same(before_[first], after_[first])) ++first;
  while (last < shorter - first && same(before_[before_.size() - 1 - last], after_[after_.size() - 1 - last]))
    ++last;
  add(std::span(before_).subspan(first, before_.size() - first - last));
  add(std::span(after_).subspan(first, after_.size() - first - last));
}

std::vector<cv::Rect> DrawMemory::changes(const ImDrawData& data, std::span<const ImTextureID> renewed) {
  const cv::Size size(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                      static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
  const std::span lists(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount));
  const bool all = size != size_;
  size_ = size;
  changed_.clear();
  // Windows come and go, but those that stay keep their order, unless one is brought to the front.
  std::size_t next = 0;
  bool reordered = false;
  for (const ImDrawList* list : lists) {
    const std::string_view owner = list->_OwnerName != nullptr ? list->_OwnerName : "";
    const auto old =
        std::find_if(lists_.begin(), lists_.end(), [&](const List& l) { return l.owner == owner; });
    if (old == lists_.end()) {
      compare(nullptr, list, renewed);
      continue;
    }
    const auto place = static_cast<std::size_t>(old - lists_.begin());
    reordered = reordered || place < next;
    for (; next < place; ++next) compare(&lists_[next], nullptr, renewed);
    next = std::max(next, place + 1);
    compare(&*old, list, renewed);
  }
  for (; next < lists_.size(); ++next) compare(&lists_[next], nullptr, renewed);
  lists_.resize(lists.size());
  for (std::size_t i = 0; i < lists.size(); ++i) remember(*lists[i], lists_[i]);
  const cv::Rect whole({}, size);
  if (all || reordered) return {whole};

  std::vector<cv::Rect> result;
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  for (const cv::Rect2f& r : changed_) {
    const cv::Point low(static_cast<int>(std::floor((r.x - origin.x) * scale.x)) - 1,
                        static_cast<int>(std::floor((r.y - origin.y) * scale.y)) - 1);
    const cv::Point high(static_cast<int>(std::ceil((r.x + r.width - origin.x) * scale.x)) + 1,
                         static_cast<int>(std::ceil((r.y + r.height - origin.y) * scale.y)) + 1);
    if (const cv::Rect box = cv::Rect(low, high) & whole; !box.empty()) result.push_back(box);
  }
  unite(result);
  return result;
}

std::vector<ImVec4> clips_of(const ImDrawData& data) {
  std::vector<ImVec4> clips;
  for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount)))
    for (const ImDrawCmd& command : list->CmdBuffer) clips.push_back(command.ClipRect);
  return clips;
}

void cut(ImDrawData& data, const std::vector<ImVec4>& whole, const cv::Rect& part) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const ImVec4 seen{origin.x + static_cast<float>(part.x) / scale.x,
                    origin.y + static_cast<float>(part.y) / scale.y,
                    origin.x + static_cast<float>(part.x + part.width) / scale.x,
                    origin.y + static_cast<float>(part.y + part.height) / scale.y};
  auto clip = whole.begin();
  for (ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount)))
    for (ImDrawCmd& command : list->CmdBuffer) {
      command.ClipRect = {std::max(clip->x, seen.x), std::max(clip->y, seen.y), std::min(clip->z, seen.z),
                          std::min(clip->w, seen.w)};
      ++clip;
    }
}

}  // namespace saccade
