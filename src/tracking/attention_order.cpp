#include "tracking/attention_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracking/cell_projection.hpp"
#include "tracking/object_merging.hpp"

namespace saccade {

const std::vector<std::size_t>& AttentionOrder::choose(const View& view, int count,
                                                       const ObjectShapes& shapes,
                                                       ProtoObjects& proto_objects, ObjectMemory& objects,
                                                       SurfaceMemory& surfaces) {
  view_ = &view;
  objects_ = &objects;
  surfaces_ = &surfaces;
  begin(shapes);
  list_expected();
  chosen_.clear();
  while (static_cast<int>(chosen_.size()) < count) {
    const auto winner = competition_.winner();
    if (!winner) break;
    TrackedObject* next = expected();
    if (next == nullptr ||
        (competition_.value(*winner) > kMargin * strength(*next) && may_enter(*winner, count, shapes)))
      next = &stands_for(*winner, shapes, proto_objects);
    if (!next->chosen && confirm(*next)) {
      make_room(*next, count);
      take(*next, proto_objects);
    } else {
      inhibit(*next);
    }
  }
  rank_the_rest();
  return chosen_;
}

void AttentionOrder::begin(const ObjectShapes& shapes) {
  for (TrackedObject& object : objects_->slots()) {
    const double age_s = static_cast<double>(view_->frame.timestamp_us - object.first_seen_us) * 1e-6;
    object.appeared = object.appeared && age_s < kAppeared_s;
    object.evidence = 0;
  }
  values_ = surfaces_->mean();
  for (int i = 0; i < static_cast<int>(values_.size()); ++i) {
    TrackedObject* owner = objects_->of_owner(surfaces_->owner()[at(i)]);
    const int segment = view_->segments.of_cell()[at(i)];
    if (owner != nullptr ? owner->appeared : has_appeared(segment, shapes)) values_[at(i)] *= kAppeared;
    if (owner != nullptr) owner->evidence = std::max(owner->evidence, values_[at(i)]);
  }
  competition_.begin(values_, view_->grid.rows(), view_->grid.cols());
}

bool AttentionOrder::has_appeared(int segment, const ObjectShapes& shapes) const {
  if (!view_->segments.is_of_thing(segment)) return false;
  const ObjectShapes::Segment& facts = shapes.segment(segment);
  return facts.appeared >= kAppearedCells && facts.appeared >= kAppearedPart * facts.cells;
}

// Objects in the order of the frame before; those that were not in it, or were away for long, come last.
void AttentionOrder::list_expected() {
  auto& slots = objects_->slots();
  expected_.clear();
  next_expected_ = 0;
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    TrackedObject& object = slots[slot];
    if (!object.alive || object.id == 0 || object.sight != Sight::visible) continue;
    if (object.member && was_away(object)) {
      object.member = false;
      object.rank = std::numeric_limits<int>::max();
    }
    expected_.push_back(slot);
  }
  std::sort(expected_.begin(), expected_.end(), [&](std::size_t a, std::size_t b) {
    return slots[a].rank != slots[b].rank ? slots[a].rank < slots[b].rank : slots[a].id < slots[b].id;
  });
}

bool AttentionOrder::was_away(const TrackedObject& object) const {
  return object.unreported_s(view_->frame.timestamp_us) - view_->seconds > kAway_s;
}

// The next that has not been chosen and has some value left.
TrackedObject* AttentionOrder::expected() {
  for (; next_expected_ < expected_.size(); ++next_expected_) {
    TrackedObject& object = objects_->slots()[expected_[next_expected_]];
    if (!object.chosen && !object.passed_over && strength(object) > 0) return &object;
  }
  return nullptr;
}

// The weakest of the members that have not been chosen, if there are as many of them as places are left; else
// nullptr.
TrackedObject* AttentionOrder::last_to_stay(int count) {
  int members = 0;
  TrackedObject* weakest = nullptr;
  for (const std::size_t slot : expected_) {
    TrackedObject& object = objects_->slots()[slot];
    if (!object.member || object.chosen || object.passed_over || object.is_part() || !(strength(object) > 0))
      continue;
    ++members;
    if (weakest == nullptr || object.evidence < weakest->evidence) weakest = &object;
  }
  return members >= count - static_cast<int>(chosen_.size()) ? weakest : nullptr;
}

// Whether what the cell speaks for is a member, or may become one. What has appeared always may.
bool AttentionOrder::may_enter(int cell, int count, const ObjectShapes& shapes) {
  const TrackedObject* owner = objects_->of_owner(surfaces_->owner()[at(cell)]);
  if (owner != nullptr && (owner->member || owner->chosen)) return true;
  if (owner != nullptr ? owner->appeared : has_appeared(view_->segments.of_cell()[at(cell)], shapes))
    return true;
  const TrackedObject* weakest = last_to_stay(count);
  return weakest == nullptr || values_[at(cell)] > kEnter * weakest->evidence;
}

// Before a newcomer takes a place that a member waits for.
void AttentionOrder::make_room(const TrackedObject& newcomer, int count) {
  if (newcomer.member || newcomer.is_part()) return;
  if (TrackedObject* weakest = last_to_stay(count)) weakest->passed_over = true;
}

// What is in view and was not chosen lines up behind. What is hidden keeps its rank for when it is seen
// again.
void AttentionOrder::rank_the_rest() {
  int rank = static_cast<int>(chosen_.size());
  for (const std::size_t slot : expected_)
    if (TrackedObject& object = objects_->slots()[slot]; !object.chosen) {
      object.rank = rank++;
      object.member = false;
    }
}

// The object that the winning cell speaks for: its owner, or the one whose segment reaches there.
TrackedObject& AttentionOrder::stands_for(int cell, const ObjectShapes& shapes, ProtoObjects& proto_objects) {
  if (TrackedObject* owner = objects_->of_owner(surfaces_->owner()[at(cell)])) return *owner;
  const int segment = view_->segments.of_cell()[at(cell)];
  const int slot = view_->segments.is_of_thing(segment) ? slot_of(segment, cell, shapes) : -1;
  if (slot < 0) return new_candidate(cell, shapes, proto_objects);
  TrackedObject& object = objects_->slots()[at(slot)];
  for (int other : proto_objects.around(cell)) {
    int& owner = surfaces_->owner()[at(other)];
    if (owner != SurfaceMemory::kNobody) continue;
    owner = objects_->owner_of(object);
    object.cells.push_back(other);
  }
  return object;
}

// Of the object that a segment belongs to: one that has a good part of its cells there, or one that most of
// the segment's cells come from, if it is convex from its anchor to the winning cell: the segment was cut
// off.
int AttentionOrder::slot_of(int segment, int cell, const ObjectShapes& shapes) const {
  const ObjectShapes::Segment& facts = shapes.segment(segment);
  if (facts.claimant >= 0 || facts.part_of < 0) return facts.claimant;
  const TrackedObject& object = objects_->slots()[at(facts.part_of)];
  const bool one =
      object.alive && object.anchor_cell >= 0 && convex_between(view_->grid, object.anchor_cell, cell);
  return one ? facts.part_of : -1;
}

TrackedObject& AttentionOrder::new_candidate(int cell, const ObjectShapes& shapes,
                                             ProtoObjects& proto_objects) {
  TrackedObject& object = objects_->add();
  const int owner = objects_->owner_of(object), segment = view_->segments.of_cell()[at(cell)];
  object.disc = !view_->segments.is_of_thing(segment);
  object.appeared = has_appeared(segment, shapes);
  object.sight = Sight::visible;
  object.first_seen_us = view_->frame.timestamp_us;
  for (int other : proto_objects.around(cell)) {
    int& own = surfaces_->owner()[at(other)];
    if (own != SurfaceMemory::kNobody && !view_->first) continue;
    own = owner;
    object.cells.push_back(other);
  }
  object.anchor_sight = AnchorSight::visible;
  object.anchor_cell = cell;
  move_anchor(object, cell, proto_objects);
  return object;
}

bool AttentionOrder::confirm(TrackedObject& object) {
  if (!object.is_part()) ++object.times_chosen;
  if (object.id != 0) return true;
  object.chosen = true;
  if (object.times_chosen < kConfirm && !view_->first) return false;
  objects_->give_id(object);
  object.thing = object.id;
  return true;
}

void AttentionOrder::take(TrackedObject& object, const ProtoObjects& proto_objects) {
  object.chosen = true;
  object.strength = strength(object);
  object.rank = static_cast<int>(chosen_.size());
  object.last_reported_us = view_->frame.timestamp_us;
  object.point_cell = settle_anchor(object, proto_objects);
  inhibit(object);
  object.member = !object.is_part();
  if (object.is_part()) return;
  competition_.discount_around(object.point_cell);
  chosen_.push_back(at(objects_->owner_of(object) - 1));
}

// Of the margin, the cells that belong to another object's segment are spared: they are its own to lose.
void AttentionOrder::inhibit(const TrackedObject& object) {
  reach_over_planes(object);
  competition_.inhibit(reached_, [&](int cell) {
    if (view_->first) return false;
    const TrackedObject* owner = objects_->of_owner(surfaces_->owner()[at(cell)]);
    return owner != nullptr && owner != &object && !owner->disc;
  });
}

// On a supporting plane, and not of another object that has a segment.
bool AttentionOrder::is_free_plane(int cell, const TrackedObject& object) const {
  const int segment = view_->segments.of_cell()[at(cell)];
  if (segment == SurfaceSegments::kNone || !view_->segments.is_supporting_plane(segment)) return false;
  const TrackedObject* owner = objects_->of_owner(surfaces_->owner()[at(cell)]);
  return owner == nullptr || owner == &object || owner->disc;
}

// Sets reached_ to the cells of an object and those of supporting planes around it. Rings of four and of
// eight neighbours in turns make it an octagon.
void AttentionOrder::reach_over_planes(const TrackedObject& object) {
  reached_.reserve(view_->grid.size());
  reached_ = object.cells;
  if (view_->first) return;
  const int cols = view_->grid.cols();
  in_reach_.assign(view_->grid.size(), 0);
  for (const int cell : reached_) in_reach_[at(cell)] = 1;
  std::size_t begin = 0;
  for (int step = 0; step < kPlaneCells; ++step) {
    const std::size_t end = reached_.size();
    for (std::size_t k = begin; k < end; ++k) {
      const int row = reached_[k] / cols, col = reached_[k] % cols;
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) {
          if ((step % 2 == 0 && v != 0 && u != 0) || !in_grid(view_->grid, row + v, col + u)) continue;
          const int cell = reached_[k] + v * cols + u;
          if (in_reach_[at(cell)] || !is_free_plane(cell, object)) continue;
          in_reach_[at(cell)] = 1;
          reached_.push_back(cell);
        }
    }
    begin = end;
  }
}

AttentionOrder::Peak AttentionOrder::best_of(const TrackedObject& object) const {
  Peak best;
  for (int cell : object.cells)
    if (competition_.value(cell) > best.value) best = {cell, competition_.value(cell)};
  return best;
}

AttentionOrder::Peak AttentionOrder::best_at_anchor(const TrackedObject& object) const {
  Peak best{object.anchor_cell, 0};
  const int own = objects_->owner_of(object), cols = view_->grid.cols();
  const int row = object.anchor_cell / cols, col = object.anchor_cell % cols;
  for (int r = row - kPlaceCells; r <= row + kPlaceCells; ++r)
    for (int c = col - kPlaceCells; c <= col + kPlaceCells; ++c) {
      const int away = (r - row) * (r - row) + (c - col) * (c - col), cell = r * cols + c;
      if (!in_grid(view_->grid, r, c) || away > kPlaceCells * kPlaceCells ||
          surfaces_->owner()[at(cell)] != own)
        continue;
      if (competition_.value(cell) > best.value) best = {cell, competition_.value(cell)};
    }
  return best;
}

float AttentionOrder::strength(const TrackedObject& object) const {
  return object.anchor_cell >= 0 ? best_at_anchor(object).value : best_of(object).value;
}

// Moves the anchor where it must; gives the cell where the object's point is in this frame.
int AttentionOrder::settle_anchor(TrackedObject& object, const ProtoObjects& proto_objects) const {
  if (object.home_mm && (object.from_home_s += view_->seconds) > kAway_s) object.home_mm.reset();
  const Peak best = best_of(object);
  double patience = kPatience_s;
  int other = best.cell;
  if (object.anchor_sight == AnchorSight::visible) {
    const int inside = cell_inside(object);
    object.at_border_s =
        std::max(0.0, object.at_border_s + (inside == object.anchor_cell ? -1 : 1) * view_->seconds);
    if (best.value <= kBetterPlace * object.strength) {
      other = object.at_border_s > kPatience_s ? inside : object.anchor_cell;
      patience = 0;
    }
    if (other == object.anchor_cell) {
      object.other_anchor_s = 0;
      return object.anchor_cell;
    }
  } else {
    if (const int near = stand_in(object); near >= 0) {
      other = near;
      if (object.anchor_sight == AnchorSight::off) patience = 0;
    }
    if (object.anchor_sight == AnchorSight::out_of_view) patience = 0;
  }
  object.other_anchor_s += view_->seconds;
  if (object.other_anchor_s > patience) {
    if (object.anchor_sight == AnchorSight::out_of_view && !object.home_mm) {
      object.home_mm = object.anchor_mm;
      object.from_home_s = 0;
    }
    move_anchor(object, other, proto_objects);
    object.anchor_cell = other;
    object.other_anchor_s = object.at_border_s = 0;
  }
  return object.anchor_cell >= 0 ? object.anchor_cell : other;
}

// The nearest cell to the anchor that has the same segment on all four sides; the anchor's own if none is
// within kPlaceCells, or if the segment is not what the object looked like before. At a border it is left to
// the noise of the depth whether a pixel is the object's.
int AttentionOrder::cell_inside(const TrackedObject& object) const {
  const std::vector<int>& segments = view_->segments.of_cell();
  const int own = segments[at(object.anchor_cell)], cols = view_->grid.cols();
  if (object.disc || object.other_shape_s > 0 || own != object.segment) return object.anchor_cell;
  const auto is_own = [&](int r, int c) {
    return in_grid(view_->grid, r, c) && segments[at(r * cols + c)] == own;
  };
  const int row = object.anchor_cell / cols, col = object.anchor_cell % cols;
  int nearest = kPlaceCells * kPlaceCells + 1, best = object.anchor_cell;
  for (int r = row - kPlaceCells; r <= row + kPlaceCells; ++r)
    for (int c = col - kPlaceCells; c <= col + kPlaceCells; ++c) {
      const int away = (r - row) * (r - row) + (c - col) * (c - col);
      if (away >= nearest || !is_own(r, c) || !is_own(r - 1, c) || !is_own(r + 1, c) || !is_own(r, c - 1) ||
          !is_own(r, c + 1))
        continue;
      nearest = away;
      best = r * cols + c;
    }
  return best;
}

// The cell of the object that is nearest to its hidden anchor; -1 if none is near.
int AttentionOrder::stand_in(const TrackedObject& object) const {
  const auto place = place_of(view_->grid, view_->from_world * object.anchor_mm);
  if (!place) return -1;
  double nearest = kStandInCells * kStandInCells;
  int best = -1;
  for (int cell : object.cells) {
    const int row = cell / view_->grid.cols(), col = cell % view_->grid.cols();
    const double down = row - place->row, right = col - place->col;
    if (down * down + right * right >= nearest) continue;
    nearest = down * down + right * right;
    best = cell;
  }
  return best;
}

void AttentionOrder::move_anchor(TrackedObject& object, int cell, const ProtoObjects& proto_objects) const {
  const cv::Point pixel = proto_objects.fixated_pixel(view_->saliency, cell);
  const Frame& frame = view_->frame;
  object.anchor_mm = view_->to_world *
                     frame.intrinsics.point_mm(pixel.y, pixel.x, static_cast<double>(frame.depth_mm(pixel)));
}

}  // namespace saccade
