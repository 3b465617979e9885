#pragma once

#include <chrono>
#include <cstdint>
#include <deque>

namespace saccade {

/// How many a second come of something that is counted, over the last two seconds. One thread at a time.
class RateMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `total` have come up to `now`, which does not go back. A smaller total than before begins anew.
  void count(std::int64_t total, Time now);

  double rate_hz() const;  ///< 0 = nothing comes, or it is not known yet

 private:
  struct Count {
    Time at;
    std::int64_t total;
  };
  std::deque<Count> counts_;
};

}  // namespace saccade
