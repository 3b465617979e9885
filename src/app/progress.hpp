#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "pipeline/ledger.hpp"
#include "pipeline/stage_statistics.hpp"

namespace saccade {

/// "45 of 90 frames, 38.2/s, 1 s left"; the total and the time left only if the total is known.
std::string progress_text(std::int64_t done, std::optional<std::int64_t> total, double elapsed_s);

/// "latency 34 ms (95 %: 41), 12 dropped": what matters of live work.
std::string live_text(const Ledger& ledger, const DurationHistogram& latency);

/// A progress line on standard error that overwrites itself; silent unless that is a terminal.
class Progress {
 public:
  Progress(bool wanted, std::optional<std::int64_t> total);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `more` is asked for what is to stand at the end, only when the line is drawn.
  void update(std::int64_t done, const std::function<std::string()>& more = {});

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  std::optional<std::int64_t> total_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

}  // namespace saccade
