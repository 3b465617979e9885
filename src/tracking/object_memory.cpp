#include "tracking/object_memory.hpp"

#include <algorithm>

#include "tracking/cell_projection.hpp"

namespace saccade {
namespace {

// Parts of the points of an object's surface.
constexpr double kVisible = 0.3;  // so many seen: the object is visible
constexpr double kSeen = 0.3;     // so many seen or seen through, it is known whether its place is empty
constexpr double kThrough = 0.6;  // so many of these seen through: it is empty

}  // namespace

void ObjectMemory::clear() {
  for (TrackedObject& object : slots_) object.alive = false;
}

TrackedObject& ObjectMemory::add() {
  auto slot = std::find_if(slots_.begin(), slots_.end(), [](const TrackedObject& o) { return !o.alive; });
  if (slot == slots_.end()) slot = slots_.emplace(slots_.end());
  TrackedObject fresh;
  fresh.alive = true;
  fresh.surface_mm.swap(slot->surface_mm);  // their memory is used again
  fresh.seen_cells.swap(slot->seen_cells);
  fresh.cells.swap(slot->cells);
  for (auto* cells : {&fresh.seen_cells, &fresh.cells}) cells->clear();
  fresh.surface_mm.clear();
  *slot = std::move(fresh);
  return *slot;
}

TrackedObject* ObjectMemory::find(int id) {
  const auto found = std::find_if(slots_.begin(), slots_.end(),
                                  [&](const TrackedObject& o) { return o.alive && o.id == id; });
  return found == slots_.end() ? nullptr : &*found;
}

void ObjectMemory::correct(const cv::Affine3d& correction) {
  for (TrackedObject& object : slots_) {
    if (!object.alive || object.sight != Sight::visible) continue;
    object.anchor_mm = correction * object.anchor_mm;
    object.centroid_mm = correction * object.centroid_mm;
    if (object.home_mm) object.home_mm = correction * *object.home_mm;
    for (cv::Point3d& point : object.surface_mm) point = correction * point;
  }
}

void ObjectMemory::predict(const SurfaceGrid& grid, const cv::Affine3d& from_world) {
  for (TrackedObject& object : slots_) {
    object.cells.clear();
    object.seen_cells.clear();
    object.segment = -1;
    object.chosen = object.passed_over = false;
    if (!object.alive) continue;
    look_at_surface(grid, from_world, object);
    if (!goes_home(grid, from_world, object)) look_at_anchor(grid, from_world, object);
  }
}

// An anchor that is seen again has its place back.
bool ObjectMemory::goes_home(const SurfaceGrid& grid, const cv::Affine3d& from_world,
                             TrackedObject& object) const {
  if (!object.home_mm) return false;
  const cv::Point3d stand_in = object.anchor_mm;
  object.anchor_mm = *object.home_mm;
  look_at_anchor(grid, from_world, object);
  const bool seen = object.anchor_sight == AnchorSight::visible;
  if (seen)
    object.home_mm.reset();
  else
    object.anchor_mm = stand_in;
  return seen;
}

void ObjectMemory::look_at_surface(const SurfaceGrid& grid, const cv::Affine3d& from_world,
                                   TrackedObject& object) const {
  int same = 0, through = 0;
  for (const cv::Point3d& world : object.surface_mm) {
    const cv::Point3d point = from_world * world;
    const int cell = cell_of(grid, point);
    if (cell < 0) continue;
    const Seen seen = compare_depth(grid.depth_mm()[static_cast<std::size_t>(cell)], point.z);
    if (seen == Seen::same) object.seen_cells.push_back(cell);
    same += seen == Seen::same;
    through += seen == Seen::farther;
  }
  const auto points = static_cast<double>(object.surface_mm.size());
  const bool empty = same + through >= kSeen * points && through > kThrough * (same + through);
  object.frames_empty = empty ? object.frames_empty + 1 : 0;
  object.sight = empty                                   ? Sight::empty
                 : same > 0 && same >= kVisible * points ? Sight::visible
                                                         : Sight::hidden;
}

// On the nearest of the cells around its place that lie at its depth.
void ObjectMemory::look_at_anchor(const SurfaceGrid& grid, const cv::Affine3d& from_world,
                                  TrackedObject& object) const {
  const cv::Point3d point = from_world * object.anchor_mm;
  const int middle = cell_of(grid, point);
  object.anchor_sight = AnchorSight::out_of_view;
  object.anchor_cell = -1;
  if (middle < 0) return;
  int nearer = 0, farther = 0, best = 3;  // squared distance in cells
  const int row = middle / grid.cols(), col = middle % grid.cols();
  for (int r = row - 1; r <= row + 1; ++r)
    for (int c = col - 1; c <= col + 1; ++c) {
      if (!in_grid(grid, r, c)) continue;
      const int cell = r * grid.cols() + c, away = (r - row) * (r - row) + (c - col) * (c - col);
      const Seen seen = compare_depth(grid.depth_mm()[static_cast<std::size_t>(cell)], point.z);
      nearer += seen == Seen::nearer;
      farther += seen == Seen::farther;
      if (seen != Seen::same || away >= best) continue;
      best = away;
      object.anchor_cell = cell;
    }
  if (object.anchor_cell >= 0)
    object.anchor_sight = AnchorSight::visible;
  else
    object.anchor_sight = farther > nearer ? AnchorSight::off : AnchorSight::hidden;
}

void ObjectMemory::learn(const SurfaceGrid& grid, const cv::Affine3d& to_world) {
  for (TrackedObject& object : slots_) {
    if (!object.alive || object.sight != Sight::visible || object.cells.empty()) continue;
    ++object.frames_seen;
    const std::size_t step = std::max<std::size_t>(1, object.cells.size() / kSurfacePoints);
    object.surface_mm.clear();
    cv::Point3d sum;
    double area = 0;
    for (std::size_t k = 0; k < object.cells.size(); ++k) {
      const cv::Point3d point = cell_point_mm(grid, object.cells[k]);
      area += point.z * point.z;
      if (k % step != 0) continue;
      object.surface_mm.push_back(to_world * point);
      sum += object.surface_mm.back();
    }
    object.centroid_mm = sum / static_cast<double>(object.surface_mm.size());
    object.area_mm2 = area / (grid.camera().fx * grid.camera().fy);
  }
}

bool ObjectMemory::candidate_stays(TrackedObject& candidate) {
  candidate.frames_missed = candidate.chosen ? 0 : candidate.frames_missed + 1;
  return candidate.frames_missed < kMissedFrames;
}

bool ObjectMemory::is_remembered(const TrackedObject& object, std::int64_t time_us) const {
  return object.unreported_s(time_us) <= memory_s_;
}

void ObjectMemory::forget(std::int64_t time_us, std::vector<int>& owner) {
  bool any = false;
  for (TrackedObject& object : slots_) {
    if (!object.alive) continue;
    object.alive = object.frames_empty < kEmptyFrames &&
                   (object.id == 0 ? candidate_stays(object) : is_remembered(object, time_us));
    any = any || !object.alive;
  }
  if (!any) return;
  for (int& own : owner)
    if (own != 0 && !slots_[static_cast<std::size_t>(own - 1)].alive) own = 0;
}

}  // namespace saccade
