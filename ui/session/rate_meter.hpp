#pragma once

#include <chrono>
#include <cstdint>
#include <deque>

namespace saccade {

/// The rate of something that is counted, over the last two seconds. One thread at a time.
class RateMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// The count is `total` at `now`, which does not go back. A smaller total than before starts again.
  void count(std::int64_t total, Time now);

  [[nodiscard]] double rate_hz() const;  ///< 0 = nothing comes, or not known yet

 private:
  struct Count {
    Time at;
    std::int64_t total;
  };
  std::deque<Count> counts_;
};

}  // namespace saccade
