#include "ui/session/rate_meter.hpp"

namespace saccade {

void RateMeter::count(std::int64_t total, Time now) {
  constexpr std::chrono::seconds kRecent{2};
  if (!counts_.empty() && total < counts_.back().total) counts_.clear();
  counts_.push_back({now, total});
  while (now - counts_.front().at > kRecent && counts_.size() > 2) counts_.pop_front();
}

double RateMeter::rate_hz() const {
  if (counts_.size() < 2) return 0;
  const double span_s = std::chrono::duration<double>(counts_.back().at - counts_.front().at).count();
  return span_s > 0 ? static_cast<double>(counts_.back().total - counts_.front().total) / span_s : 0;
}

}  // namespace saccade
