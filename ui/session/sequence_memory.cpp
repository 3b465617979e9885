#include "ui/session/sequence_memory.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace saccade {

void SequenceMemory::next_frame() {
  if (attended_) before_ = now_;
  attended_ = false;
}

void SequenceMemory::attend(const FrameFollower& follower, std::int64_t number, const SequenceMemory& other,
                            Computed& computed) {
  const Settings& settings = computed.settings;
  Result& result = computed.result;
  if (!follows(number) && other.follows(number)) before_ = other.before_;
  now_ = before_;
  attended_ = true;
  const bool other_map = !same_values(SettingScope::model, now_.settings, settings);
  if (other_map) now_.tracker.forget_evidence();
  now_.tracker.configure(settings.fixations, settings.min_confidence, settings);
  CameraStep step = follower.step();
  if (now_.number != 0 && !follows(number)) step.cut = true;
  now_.known = before_.numbers;
  if (step.cut) {
    const int first = first_id_after_cut(other, result.frame);
    now_.tracker.number_from(first);
    now_.known.of.clear();
    if (first == 1) now_.known.used = {};
  }
  now_.tracker.attend(result.frame, result.maps.master, follower.surfaces(), step, result.attention);
  double largest = 0;
  cv::minMaxLoc(computed.smooth, nullptr, &largest);
  computed.marks = now_.marks.next(result.frame, result.attention, static_cast<float>(largest), other_map,
                                   settings.return_after_s);
  now_.settings = settings;
  now_.number = number;
  now_.index = result.frame.index;
}

// The other side may have computed this frame already, but not its before_.
int SequenceMemory::first_id_after_cut(const SequenceMemory& other, const Frame& frame) const {
  if (frame.index <= std::max(before_.index, other.before_.index)) return 1;
  return std::max(first_unused(before_), first_unused(other.before_));
}

int SequenceMemory::first_unused(const State& state) {
  return std::max(state.tracker.next_id(), state.numbers.used.next());
}

// Those of objects that are no longer remembered: it would be a long list after hours.
void SequenceMemory::forget_numbers() {
  const std::vector<TrackedObject>& objects = now_.tracker.objects().slots();
  std::erase_if(now_.numbers.of, [&](const auto& entry) {
    return std::ranges::none_of(
        objects, [&](const TrackedObject& object) { return object.alive && object.id == entry.first; });
  });
}

void SequenceMemory::number_objects(SequenceMemory& a, Computed* of_a, SequenceMemory& b, Computed* of_b) {
  struct Side {
    SequenceMemory& memory;
    Computed& computed;
    std::vector<int> ids{};
    NumberedSide numbered() { return {memory.now_.numbers.of, ids, computed.result.attention}; }
  };
  std::vector<Side> sides;
  if (of_a != nullptr) sides.push_back({a, *of_a});
  if (of_b != nullptr) sides.push_back({b, *of_b});
  UsedNumbers used;
  for (Side& side : sides) {
    for (const SequenceMarks::Mark& mark : side.computed.marks->marks) side.ids.push_back(mark.id);
    side.memory.now_.numbers = side.memory.now_.known;
    used.add(side.memory.now_.known.used);
  }
  if (sides.empty()) return;
  const std::optional<NumberedSide> second =
      sides.size() > 1 ? std::optional(sides[1].numbered()) : std::nullopt;
  assign_numbers(sides[0].numbered(), second ? &*second : nullptr, used);
  for (Side& side : sides) {
    side.memory.now_.numbers.used = used;
    Attention& attention = side.computed.result.attention;
    std::optional<int>& gaze = attention.sequence->gaze;
    const std::optional<int> looked_at = std::exchange(gaze, std::nullopt);
    for (std::size_t i = 0; i < side.ids.size(); ++i) {
      Fixation& fixation = attention.fixations[i];
      const int number = side.memory.now_.numbers.of.at(side.ids[i]);
      if (looked_at == fixation.id) gaze = number;
      fixation.id = number;
    }
    side.memory.forget_numbers();
  }
}

}  // namespace saccade
