#include "ui/session/sequence_memory.hpp"

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
  now_.tracker.attend(result.frame, result.maps.master, follower.surfaces(), step, result.attention);
  double largest = 0;
  cv::minMaxLoc(computed.smooth, nullptr, &largest);
  computed.marks = now_.marks.next(result.frame, result.attention, static_cast<float>(largest), other_map,
                                   settings.return_after_s);
  now_.settings = settings;
  now_.number = number;
}

}  // namespace saccade
