#include "tracking/gaze.hpp"

#include <algorithm>

namespace saccade {
namespace {

double seconds(std::int64_t from_us, std::int64_t to_us) {
  return static_cast<double>(to_us - from_us) * 1e-6;
}

}  // namespace

std::optional<int> Gaze::look(std::int64_t time_us, const std::vector<Target>& targets) {
  const auto at = std::find_if(targets.begin(), targets.end(),
                               [&](const Target& target) { return target.id == current_; });
  forget_old(time_us, targets);
  if (at == targets.end()) {
    current_.reset();
    const Target* other = next(time_us, targets);
    if (other == nullptr) other = longest_ago(targets);
    if (other != nullptr) turn_to(other->id, time_us);
    return current_;
  }
  note_look(at->id, time_us);
  const Target* other = next(time_us, targets);
  if (other == nullptr) return current_;
  const bool interrupts = other->appeared && other->strength > kInterrupts * at->strength;
  if (interrupts || seconds(since_us_, time_us) >= timing_.dwell_s) turn_to(other->id, time_us);
  return current_;
}

void Gaze::clear() {
  current_.reset();
  looks_.clear();
}

const Gaze::Look* Gaze::look_at(int id) const {
  const auto look = std::find_if(looks_.begin(), looks_.end(), [&](const Look& l) { return l.id == id; });
  return look == looks_.end() ? nullptr : &*look;
}

void Gaze::note_look(int id, std::int64_t time_us) {
  const auto look = std::find_if(looks_.begin(), looks_.end(), [&](const Look& l) { return l.id == id; });
  if (look == looks_.end())
    looks_.push_back({id, time_us});
  else
    look->time_us = time_us;
}

void Gaze::turn_to(int id, std::int64_t time_us) {
  current_ = id;
  since_us_ = time_us;
  note_look(id, time_us);
}

// The first in order that may be looked at; one that has appeared and was never looked at comes before
// others.
const Gaze::Target* Gaze::next(std::int64_t time_us, const std::vector<Target>& targets) const {
  const Target* first = nullptr;
  for (const Target& target : targets) {
    if (target.id == current_ || !may_return(time_us, target.id)) continue;
    if (target.appeared && look_at(target.id) == nullptr) return &target;
    if (first == nullptr) first = &target;
  }
  return first;
}

const Gaze::Target* Gaze::longest_ago(const std::vector<Target>& targets) const {
  const auto oldest = std::min_element(targets.begin(), targets.end(), [&](const Target& a, const Target& b) {
    return look_at(a.id)->time_us < look_at(b.id)->time_us;
  });
  return oldest == targets.end() ? nullptr : &*oldest;
}

bool Gaze::may_return(std::int64_t time_us, int id) const {
  const Look* look = look_at(id);
  return look == nullptr || seconds(look->time_us, time_us) >= timing_.return_after_s;
}

// Keeps the memory small over hours; what is forgotten may be looked at either way.
void Gaze::forget_old(std::int64_t time_us, const std::vector<Target>& targets) {
  std::erase_if(looks_, [&](const Look& look) {
    return seconds(look.time_us, time_us) >= timing_.return_after_s &&
           std::none_of(targets.begin(), targets.end(), [&](const Target& t) { return t.id == look.id; });
  });
}

}  // namespace saccade
