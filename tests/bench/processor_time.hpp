#pragma once

#include <time.h>

#include <algorithm>
#include <limits>

namespace saccade {

/// Of the calling thread, milliseconds.
inline double thread_processor_ms() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// The smallest processor time of some repetitions of `work` on this thread, milliseconds: what it costs when
/// nothing disturbs it.
template <typename Work>
double smallest_processor_ms(int repetitions, Work work) {
  double smallest = std::numeric_limits<double>::max();
  for (int i = 0; i < repetitions; ++i) {
    const double start = thread_processor_ms();
    work();
    smallest = std::min(smallest, thread_processor_ms() - start);
  }
  return smallest;
}

}  // namespace saccade
