#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace saccade {

/// Which object is looked at, over time: one at a time, for a while; then the strongest that was not looked
/// at lately. An object that has just appeared comes first, and interrupts if it is much stronger. Depends on
/// the times that it is given alone.
class Gaze {
 public:
  /// How much stronger an object that has appeared must be than the one looked at to interrupt.
  static constexpr float kInterrupts = 2;

  struct Timing {
    double dwell_s = 0.5;       ///< how long one object is looked at
    double return_after_s = 5;  ///< how long after it is not looked at again
  };

  /// What can be looked at in a frame.
  struct Target {
    int id = 0;
    float strength = 0;
    bool appeared = false;  ///< came into a place that was seen without it
  };

  explicit Gaze(const Timing& timing) : timing_(timing) {}
  void set_timing(const Timing& timing) { timing_ = timing; }

  /// The id that is looked at in a frame at `time_us`, which does not decrease from call to call. `targets`:
  /// what the frame reports, in the order of attention. Where all others were looked at lately, the gaze
  /// stays; where the object looked at is no target, it moves on at once. None if there is no target.
  std::optional<int> look(std::int64_t time_us, const std::vector<Target>& targets);

  /// Forgets everything: the memory has begun again.
  void clear();

 private:
  // The last look at an object.
  struct Look {
    int id;
    std::int64_t time_us;
  };

  const Look* look_at(int id) const;
  void note_look(int id, std::int64_t time_us);
  const Target* next(std::int64_t time_us, const std::vector<Target>& targets) const;
  const Target* longest_ago(const std::vector<Target>& targets) const;
  bool may_return(std::int64_t time_us, int id) const;
  void turn_to(int id, std::int64_t time_us);
  void forget_old(std::int64_t time_us, const std::vector<Target>& targets);

  Timing timing_;
  std::optional<int> current_;
  std::int64_t since_us_ = 0;
  std::vector<Look> looks_;  // one for each object
};

}  // namespace saccade
