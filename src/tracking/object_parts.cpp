#include "tracking/object_parts.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr int kNoSlot = -1;

bool is_seen(const TrackedObject* object) { return object != nullptr && object->sight == Sight::visible; }

// Whether the first is rather reported for a thing than the second. So an older part that comes back, or that
// was hardly ever chosen, does not take the place of the one that was reported all the time.
bool comes_before(const TrackedObject& a, const TrackedObject& b) {
  return a.times_chosen != b.times_chosen ? a.times_chosen > b.times_chosen : a.id < b.id;
}

}  // namespace

void ObjectParts::find(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat3b& colour,
                       double seconds, ObjectMemory& objects) {
  name_things(objects);
  // Where one of the two is out of sight, nothing is learnt of them.
  for (Pair& pair : pairs_)
    if (is_seen(objects.find(pair.a)) && is_seen(objects.find(pair.b))) pair.left_s -= seconds;
  const auto& slots = objects.slots();
  find_cells(grid, segments, objects);
  for (const HeldObjects::Pair& pair : held_.find(grid, slot_of_, static_cast<int>(slots.size())))
    note(slots[at(pair.held)], slots[at(pair.holder)], objects);
  if (!colour.empty()) {
    looks_.assign(slots.size(), {});
    for (std::size_t slot = 0; slot < slots.size(); ++slot)
      look_at(grid, segments, colour, slots[slot], static_cast<int>(slot));
    count_contacts(grid);
    pair_up(objects);
  }
  std::erase_if(pairs_, [&](const Pair& pair) {
    return pair.left_s <= 0 || objects.find(pair.a) == nullptr || objects.find(pair.b) == nullptr;
  });
  name_things(objects);
}

// Whose each cell is, in segments that are no supporting planes.
void ObjectParts::find_cells(const SurfaceGrid& grid, const SurfaceSegments& segments,
                             const ObjectMemory& objects) {
  slot_of_.assign(grid.size(), kNoSlot);
  for (std::size_t slot = 0; slot < objects.slots().size(); ++slot) {
    const TrackedObject& object = objects.slots()[slot];
    if (!object.alive || object.id == 0 || !is_seen(&object) || object.disc) continue;
    for (const int cell : object.cells)
      if (segments.is_of_thing(segments.of_cell()[at(cell)])) slot_of_[at(cell)] = static_cast<int>(slot);
  }
}

// The mean colour is that of a pixel near the middle of each cell. Bright cells count more: the colour of
// dark ones is noise.
void ObjectParts::look_at(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat3b& colour,
                          const TrackedObject& object, int slot) {
  constexpr int kMiddle = SurfaceGrid::kCellPx / 2 - 1;
  cv::Vec3d sum;
  double brightness = 0, squares = 0;
  colours_.clear();
  brightness_.clear();
  for (const int cell : object.cells) {
    if (slot_of_[at(cell)] != slot) continue;
    const int row = std::min(colour.rows - 1, cell / grid.cols() * SurfaceGrid::kCellPx + kMiddle),
              col = std::min(colour.cols - 1, cell % grid.cols() * SurfaceGrid::kCellPx + kMiddle);
    const cv::Vec3d pixel(colour(row, col));
    const double bright = std::max(1.0, pixel[0] + pixel[1] + pixel[2]);
    sum += pixel;
    brightness += bright;
    squares += pixel.dot(pixel) / bright;  // = bright |chromaticity|^2
    colours_.push_back(chromaticity(grid, colour, cell));
    brightness_.push_back(bright);
  }
  if (colours_.empty()) return;
  Look& look = looks_[at(slot)];
  look.colour = sum / brightness;
  look.spread = std::sqrt(std::max(0.0, squares / brightness - look.colour.dot(look.colour)));
  look.log_brightness = std::log(brightness / static_cast<double>(colours_.size()));
  const int segment =
      object.anchor_cell >= 0 ? segments.of_cell()[at(object.anchor_cell)] : SurfaceSegments::kNone;
  if (segment != SurfaceSegments::kNone && segments.is_cut(segment)) return;
  look.own = own_colour_.find(colours_, kOwnShare);
  if (look.own) look.own_log_brightness = log_brightness_of(*look.own);
}

// Mean logarithm of the brightness of the cells that have a colour.
double ObjectParts::log_brightness_of(const cv::Vec2f& own) const {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < colours_.size(); ++k) {
    if (colours_[k][0] < 0 || distance(colours_[k], own) > OwnColour::kReach) continue;
    sum += std::log(brightness_[k]);
    ++count;
  }
  return sum / count;
}

void ObjectParts::count_contacts(const SurfaceGrid& grid) {
  const int slots = static_cast<int>(looks_.size()), cols = grid.cols();
  links_.assign(looks_.size() * looks_.size(), 0);
  const auto compare = [&](int i, int j, SurfaceGrid::Link link) {
    const int a = slot_of_[at(i)], b = slot_of_[at(j)];
    if (a == b) return;
    if (a != kNoSlot) ++looks_[at(a)].outline;
    if (b != kNoSlot) ++looks_[at(b)].outline;
    if (a != kNoSlot && b != kNoSlot && (grid.links()[at(i)] & link) != 0)
      ++links_[at(std::min(a, b) * slots + std::max(a, b))];
  };
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < cols; ++col) {
      const int i = row * cols + col;
      if (col + 1 < cols) compare(i, i + 1, SurfaceGrid::kRight);
      if (row + 1 < grid.rows()) compare(i, i + cols, SurfaceGrid::kDown);
    }
}

// tolerance: of the limits of colour.
bool ObjectParts::cling(std::size_t a, std::size_t b, double tolerance) const {
  const int links = links_[a * looks_.size() + b];
  const Look &one = looks_[a], &other = looks_[b];
  return links > 0 && links >= kContact * std::min(one.outline, other.outline) &&
         have_one_colour(one, other, tolerance);
}

bool ObjectParts::have_one_colour(const Look& one, const Look& other, double tolerance) {
  if (one.own && other.own &&
      static_cast<double>(distance(*one.own, *other.own)) < tolerance * kSameOwnColour &&
      std::abs(one.own_log_brightness - other.own_log_brightness) < kSameBrightness)
    return true;
  return std::hypot(cv::norm(one.colour - other.colour), one.spread - other.spread) <
             tolerance * kSameColour &&
         std::abs(one.log_brightness - other.log_brightness) < kSameBrightness;
}

void ObjectParts::pair_up(ObjectMemory& objects) {
  const auto& slots = objects.slots();
  for (std::size_t a = 0; a < slots.size(); ++a)
    for (std::size_t b = a + 1; b < slots.size(); ++b)
      if (cling(a, b, 1) && (!bridge(slots[a], slots[b], objects) || cling(a, b, kBridge)))
        note(slots[a], slots[b], objects);
}

// Whether two things become one that were both known for a while, so that one of them is given up.
bool ObjectParts::bridge(const TrackedObject& a, const TrackedObject& b, ObjectMemory& objects) {
  const auto is_old = [&](int thing) { return objects.find(thing)->frames_seen > kNewFrames; };
  return a.thing != b.thing && is_old(a.thing) && is_old(b.thing) && find_pair(a, b) == nullptr;
}

ObjectParts::Pair* ObjectParts::find_pair(const TrackedObject& a, const TrackedObject& b) {
  const auto pair = std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& known) {
    return known.a == std::min(a.id, b.id) && known.b == std::max(a.id, b.id);
  });
  return pair == pairs_.end() ? nullptr : &*pair;
}

void ObjectParts::note(const TrackedObject& a, const TrackedObject& b, ObjectMemory& objects) {
  if (Pair* known = find_pair(a, b)) {
    known->left_s = kKeep_s;
  } else if (std::min(a.frames_seen, b.frames_seen) <= kNewFrames) {
    pairs_.push_back({std::min(a.id, b.id), std::max(a.id, b.id)});
    name_things(objects);
  }
}

// The name of the object that comes before the others goes along the pairs until all that hangs together has
// it.
void ObjectParts::name_things(ObjectMemory& objects) const {
  for (TrackedObject& object : objects.slots()) object.thing = object.id;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Pair& pair : pairs_) {
      TrackedObject *a = objects.find(pair.a), *b = objects.find(pair.b);
      if (!is_seen(a) || !is_seen(b) || a->thing == b->thing) continue;
      const TrackedObject &one = *objects.find(a->thing), &other = *objects.find(b->thing);
      a->thing = b->thing = comes_before(one, other) ? one.id : other.id;
      changed = true;
    }
  }
}

}  // namespace saccade
