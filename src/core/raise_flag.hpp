#pragma once

#include <condition_variable>
#include <mutex>

namespace saccade {

/// Sets a flag that `mutex` guards, and wakes the threads that wait for `changed` to look at it.
inline void raise_flag(bool& flag, std::mutex& mutex, std::condition_variable& changed) {
  {
    const std::lock_guard lock(mutex);
    flag = true;
  }
  changed.notify_all();
}

}  // namespace saccade
