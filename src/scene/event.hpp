#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace saccade::scene {

/// What happens in a scene while it is watched.
enum class EventKind {
  none,
  move,  ///< an object is slid aside by kMove_mm, in kMove_s; where there is no room, it is raised
  add,   ///< an object is put in
  take,  ///< an object is taken away
  hide,  ///< a board comes down between camera and object, stays for kHide_s, and goes
};

constexpr double kMove_mm = 150, kMove_s = 1, kHide_s = 1.5;

/// An event of one scene.
struct Event {
  EventKind kind = EventKind::none;
  double at_s = 0;                       ///< when it begins
  int label = 0;                         ///< of the object that it happens to
  Vector3d shift_mm = Vector3d::Zero();  ///< of `move`
};

/// Chooses the object, and the way for `move`, by the seed: an object that the still camera sees well, not
/// furniture that fills the view. The label of the board of `hide` is scene.objects + 1.
Event plan_event(const Scene& scene, EventKind kind, double at_s, std::uint64_t seed);

/// The scene at a time, s. Labels keep their identity.
Scene scene_at(const Scene& scene, const Event& event, double time_s);

}  // namespace saccade::scene
