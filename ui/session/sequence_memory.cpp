#include "ui/session/sequence_memory.hpp"

#include <algorithm>

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
  if (step.cut) now_.tracker.number_from(first_id_after_cut(other, result.frame));
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
  return std::max(before_.tracker.next_id(), other.before_.tracker.next_id());
}

}  // namespace saccade
