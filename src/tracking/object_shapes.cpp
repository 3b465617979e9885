#include "tracking/object_shapes.hpp"

#include <algorithm>
#include <limits>

#include "attention/proto_objects.hpp"
#include "tracking/cell_projection.hpp"

namespace saccade {
namespace {

constexpr std::size_t kFewCells = 3;  // fewer carried cells than this do not say where an object is

// A segment is taken for an object that was moved if at least this part of it has just appeared, at most this
// part is another's, and its area is in this range, as a part of the object's.
constexpr double kJustAppeared = 0.5, kOthers = 0.3, kLeastArea = 0.5, kMostArea = 2;

bool is_visible(const TrackedObject& object) { return object.alive && object.sight == Sight::visible; }

}  // namespace

void ObjectShapes::claim(const SurfaceGrid& grid, const SurfaceSegments& segments,
                         const cv::Affine3d& to_world, double seconds, ObjectMemory& objects,
                         SurfaceMemory& surfaces) {
  grid_ = &grid;
  segments_ = &segments;
  of_cell_ = &segments.of_cell();
  collect_cells(objects, surfaces);
  seed(objects, surfaces);
  measure_segments(surfaces);
  follow_moved(objects, to_world, surfaces);
  choose_segments(objects, seconds, surfaces);
  take_segments(objects, surfaces);
  divide_segments(objects, surfaces);
  keep_anchors(objects, surfaces);
  collect_cells(objects, surfaces);
}

// Only a visible object has cells.
void ObjectShapes::collect_cells(ObjectMemory& objects, SurfaceMemory& surfaces) {
  for (TrackedObject& object : objects.slots()) object.cells.clear();
  for (int i = 0; i < static_cast<int>(grid_->size()); ++i) {
    int& owner = surfaces.owner()[at(i)];
    TrackedObject* object = objects.of_owner(owner);
    if (object == nullptr) continue;
    if (is_visible(*object))
      object->cells.push_back(i);
    else
      owner = SurfaceMemory::kNobody;
  }
}

// What comes back into view has no cells that were carried along.
void ObjectShapes::seed(ObjectMemory& objects, SurfaceMemory& surfaces) {
  for (TrackedObject& object : objects.slots()) {
    if (!is_visible(object) || object.cells.size() >= kFewCells) continue;
    for (int cell : object.seen_cells) {
      if (surfaces.owner()[at(cell)] != SurfaceMemory::kNobody) continue;
      surfaces.owner()[at(cell)] = objects.owner_of(object);
      object.cells.push_back(cell);
    }
  }
}

void ObjectShapes::measure_segments(const SurfaceMemory& surfaces) {
  facts_.assign(at(segments_->count()), {});
  for (int i = 0; i < static_cast<int>(grid_->size()); ++i) {
    const int segment = segment_of(i);
    if (segment == SurfaceSegments::kNone) continue;
    Segment& facts = facts_[at(segment)];
    const cv::Point3d point = cell_point_mm(*grid_, i);
    ++facts.cells;
    facts.owned += surfaces.owner()[at(i)] != SurfaceMemory::kNobody;
    facts.appeared += surfaces.before()[at(i)] == SurfaceMemory::Before::behind;
    facts.centroid_mm += point;
    facts.area_mm2 += point.z * point.z;
  }
  const double cell_area = grid_->camera().fx * grid_->camera().fy;
  for (Segment& facts : facts_) {
    facts.centroid_mm /= std::max(1, facts.cells);
    facts.area_mm2 /= cell_area;
  }
}

void ObjectShapes::follow_moved(ObjectMemory& objects, const cv::Affine3d& to_world,
                                SurfaceMemory& surfaces) {
  for (TrackedObject& object : objects.slots()) {
    if (!object.alive || object.sight != Sight::empty) continue;
    const int segment = segment_moved_to(object, to_world);
    if (segment == SurfaceSegments::kNone) continue;
    const cv::Point3d shift = to_world * facts_[at(segment)].centroid_mm - object.centroid_mm;
    object.anchor_mm += shift;
    object.home_mm.reset();
    object.centroid_mm += shift;
    object.sight = Sight::visible;
    object.frames_empty = 0;
    for (int i = 0; i < static_cast<int>(grid_->size()); ++i) {
      int& owner = surfaces.owner()[at(i)];
      if (segment_of(i) != segment || owner != SurfaceMemory::kNobody) continue;
      owner = objects.owner_of(object);
      object.cells.push_back(i);
    }
    facts_[at(segment)].owned = facts_[at(segment)].cells;
  }
}

// The nearest that fits; kNone if there is none.
int ObjectShapes::segment_moved_to(const TrackedObject& object, const cv::Affine3d& to_world) const {
  int best = SurfaceSegments::kNone;
  double nearest = object.size_mm();
  for (int segment = 0; segment < segments_->count(); ++segment) {
    const Segment& facts = facts_[at(segment)];
    if (!segments_->is_of_thing(segment) || facts.appeared < kJustAppeared * facts.cells ||
        facts.owned > kOthers * facts.cells || facts.area_mm2 < kLeastArea * object.area_mm2 ||
        facts.area_mm2 > kMostArea * object.area_mm2)
      continue;
    const double away = cv::norm(to_world * facts.centroid_mm - object.centroid_mm);
    if (away > nearest) continue;
    nearest = away;
    best = segment;
  }
  return best;
}

void ObjectShapes::count_overlaps(const std::vector<int>& cells) {
  overlap_.assign(at(segments_->count()), 0);
  for (int cell : cells)
    if (const int segment = segment_of(cell); segment != SurfaceSegments::kNone) ++overlap_[at(segment)];
}

void ObjectShapes::choose_segments(ObjectMemory& objects, double seconds, SurfaceMemory& surfaces) {
  for (TrackedObject& object : objects.slots()) {
    if (!is_visible(object)) continue;
    count_overlaps(object.cells);
    const int own_segment = choose_segment(object, seconds);
    if (object.id != 0) add_claims(object, objects.owner_of(object) - 1, own_segment);
    release_patches(object, own_segment, surfaces);
  }
}

// What was cut out by its colour is not its, unless its anchor is there.
void ObjectShapes::release_patches(TrackedObject& object, int own_segment, SurfaceMemory& surfaces) const {
  std::erase_if(object.cells, [&](int cell) {
    const int segment = segment_of(cell);
    if (segment == SurfaceSegments::kNone || segment == own_segment || !segments_->is_cut(segment))
      return false;
    surfaces.owner()[at(cell)] = SurfaceMemory::kNobody;
    return true;
  });
}

// What was cut out by its colour is not a part of what it was cut out of.
void ObjectShapes::add_claims(const TrackedObject& object, int slot, int own_segment) {
  const bool own_is_cut = own_segment != SurfaceSegments::kNone && segments_->is_cut(own_segment);
  for (int segment = 0; segment < segments_->count(); ++segment) {
    if (segment != own_segment && (segments_->is_cut(segment) || own_is_cut)) continue;
    const int shared = overlap_[at(segment)];
    Segment& facts = facts_[at(segment)];
    if (2 * shared > facts.cells) facts.part_of = slot;
    if (shared == 0 || shared < kGoodPart * static_cast<double>(object.cells.size())) continue;
    ++facts.claims;
    if (shared <= facts.claimant_cells) continue;
    facts.claimant = slot;
    facts.claimant_cells = shared;
  }
}

// The segment under the anchor or, where that is hidden, the one that holds the most of the object's cells.
// What was cut out by its colour is taken at once: the noise of depth has no part in it. Gives the segment,
// taken or not.
int ObjectShapes::choose_segment(TrackedObject& object, double seconds) {
  int segment = SurfaceSegments::kNone;
  if (object.anchor_cell >= 0)
    segment = segment_of(object.anchor_cell);
  else if (const auto most = std::max_element(overlap_.begin(), overlap_.end());
           most != overlap_.end() && *most > 0)
    segment = static_cast<int>(most - overlap_.begin());
  const bool whole = segments_->is_of_thing(segment);
  const int shared = segment == SurfaceSegments::kNone ? 0 : overlap_[at(segment)];
  const int all = (whole ? facts_[at(segment)].cells : 0) + static_cast<int>(object.cells.size()) - shared;
  const bool same = whole && shared >= kSameShape * all;
  object.other_shape_s = same ? 0 : object.other_shape_s + seconds;
  const bool cut = whole && segments_->is_cut(segment);
  if (!same && !cut && object.other_shape_s <= kPatience_s) return segment;
  object.other_shape_s = 0;
  object.disc = !whole;
  if (whole) object.segment = segment;
  return segment;
}

// A segment that only one object claims is its shape.
void ObjectShapes::take_segments(ObjectMemory& objects, SurfaceMemory& surfaces) {
  shape_of_.assign(facts_.size(), SurfaceMemory::kNobody);
  for (TrackedObject& object : objects.slots()) {
    if (!is_visible(object) || object.segment < 0) continue;
    Segment& facts = facts_[at(object.segment)];
    if (facts.claims > 1 || facts.taken) continue;
    facts.taken = true;
    shape_of_[at(object.segment)] = objects.owner_of(object);
    for (int cell : object.cells) surfaces.owner()[at(cell)] = SurfaceMemory::kNobody;
  }
  for (int i = 0; i < static_cast<int>(grid_->size()); ++i) {
    const int segment = segment_of(i);
    if (segment != SurfaceSegments::kNone && surfaces.owner()[at(i)] == SurfaceMemory::kNobody)
      surfaces.owner()[at(i)] = shape_of_[at(segment)];
  }
}

// What nobody owns of a segment that several claim goes to the nearest anchor in it.
void ObjectShapes::divide_segments(ObjectMemory& objects, SurfaceMemory& surfaces) {
  const auto divided = [&](int segment) {
    return segments_->is_of_thing(segment) && facts_[at(segment)].claims > 1 && !facts_[at(segment)].taken;
  };
  for (int i = 0; i < static_cast<int>(grid_->size()); ++i) {
    const int segment = segment_of(i);
    if (!divided(segment) || surfaces.owner()[at(i)] != SurfaceMemory::kNobody) continue;
    int nearest = std::numeric_limits<int>::max();
    for (const TrackedObject& object : objects.slots()) {
      if (!is_visible(object) || object.anchor_cell < 0 || segment_of(object.anchor_cell) != segment)
        continue;
      const int down = object.anchor_cell / grid_->cols() - i / grid_->cols(),
                right = object.anchor_cell % grid_->cols() - i % grid_->cols();
      if (down * down + right * right >= nearest) continue;
      nearest = down * down + right * right;
      surfaces.owner()[at(i)] = objects.owner_of(object);
    }
  }
}

// An object has its anchor's place in any case; one without a segment has a disc.
void ObjectShapes::keep_anchors(ObjectMemory& objects, SurfaceMemory& surfaces) {
  for (TrackedObject& object : objects.slots()) {
    if (!is_visible(object) || object.anchor_cell < 0) continue;
    const int owner = objects.owner_of(object);
    if (object.disc)
      for (int cell : object.cells)
        if (surfaces.owner()[at(cell)] == owner) surfaces.owner()[at(cell)] = SurfaceMemory::kNobody;
    keep_anchor(object, owner, surfaces);
  }
}

void ObjectShapes::keep_anchor(TrackedObject& object, int owner, SurfaceMemory& surfaces) const {
  const int reach = object.disc ? ProtoObjects::kDiscCells : kAnchorCells;
  const int row = object.anchor_cell / grid_->cols(), col = object.anchor_cell % grid_->cols();
  const double depth = static_cast<double>(grid_->depth_mm()[at(object.anchor_cell)]);
  for (int r = row - reach; r <= row + reach; ++r)
    for (int c = col - reach; c <= col + reach; ++c) {
      const int away = (r - row) * (r - row) + (c - col) * (c - col), cell = r * grid_->cols() + c;
      if (!in_grid(*grid_, r, c) || away > reach * reach || grid_->depth_mm()[at(cell)] == 0) continue;
      int& own = surfaces.owner()[at(cell)];
      const bool at_anchor = away <= kAnchorCells * kAnchorCells &&
                             compare_depth(grid_->depth_mm()[at(cell)], depth) == Seen::same;
      const bool free = own == SurfaceMemory::kNobody && segment_of(cell) == segment_of(object.anchor_cell);
      if (free || (at_anchor && object.id != 0)) own = owner;
    }
}

}  // namespace saccade
