#include "tracking/object_merging.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace saccade {
namespace {

constexpr float kGap = 0.25F;  // of a jump; more is farther than the line

// Has an id, and its anchor is seen on a segment that is no supporting plane.
bool is_placed(const TrackedObject& object, const SurfaceSegments& segments) {
  if (!object.alive || object.id == 0 || object.sight != Sight::visible || object.anchor_cell < 0)
    return false;
  return segments.is_of_thing(segments.of_cell()[at(object.anchor_cell)]);
}

}  // namespace

// 1/z is linear along a straight line in the image.
bool convex_between(const SurfaceGrid& grid, int from, int to) {
  const int cols = grid.cols(), down = to / cols - from / cols, right = to % cols - from % cols;
  const int steps = std::max(std::abs(down), std::abs(right));
  const float w_from = grid.inverse_depth()[at(from)], w_to = grid.inverse_depth()[at(to)];
  for (int k = 1; k < steps; ++k) {
    const float part = static_cast<float>(k) / static_cast<float>(steps);
    const int row = from / cols + static_cast<int>(std::lround(part * static_cast<float>(down))),
              col = from % cols + static_cast<int>(std::lround(part * static_cast<float>(right)));
    const float z = grid.depth_mm()[at(row * cols + col)], line = 1 / (w_from + part * (w_to - w_from));
    if (z == 0 || z > line + kGap * SurfaceGrid::jump_mm(line)) return false;
  }
  return true;
}

void ObjectMerging::merge(const SurfaceGrid& grid, const SurfaceSegments& segments, double seconds,
                          ObjectMemory& objects, SurfaceMemory& surfaces) {
  for (Pair& pair : pairs_) pair.now = false;
  find_pairs(grid, segments, objects);
  for (Pair& pair : pairs_) {
    pair.seconds += pair.now ? seconds : -seconds;
    if (pair.seconds < kPatience_s) continue;
    pair.seconds = 0;
    TrackedObject *a = objects.find(pair.a), *b = objects.find(pair.b);
    if (a == nullptr || b == nullptr) continue;  // joined with a third one
    if (b->rank < a->rank) std::swap(a, b);
    join(*a, *b, objects, surfaces);
  }
  std::erase_if(pairs_, [](const Pair& pair) { return pair.seconds <= 0; });
}

void ObjectMerging::find_pairs(const SurfaceGrid& grid, const SurfaceSegments& segments,
                               const ObjectMemory& objects) {
  const auto& slots = objects.slots();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (!is_placed(slots[i], segments)) continue;
    for (std::size_t j = i + 1; j < slots.size(); ++j) {
      if (!is_placed(slots[j], segments)) continue;
      const int a = slots[i].anchor_cell, b = slots[j].anchor_cell;
      if (segments.of_cell()[at(a)] == segments.of_cell()[at(b)] && convex_between(grid, a, b))
        note(std::min(slots[i].id, slots[j].id), std::max(slots[i].id, slots[j].id));
    }
  }
}

void ObjectMerging::note(int a, int b) {
  const auto found =
      std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& p) { return p.a == a && p.b == b; });
  if (found != pairs_.end())
    found->now = true;
  else
    pairs_.push_back({a, b, true, 0});
}

void ObjectMerging::join(TrackedObject& first, TrackedObject& second, ObjectMemory& objects,
                         SurfaceMemory& surfaces) {
  const int from = objects.owner_of(second), to = objects.owner_of(first);
  for (int i = 0; i < static_cast<int>(surfaces.owner().size()); ++i) {
    int& owner = surfaces.owner()[at(i)];
    if (owner != from) continue;
    owner = to;
    first.cells.push_back(i);
  }
  second.alive = false;
  second.cells.clear();
}

}  // namespace saccade
