#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "pipeline/ledger.hpp"
#include "pipeline/stage_statistics.hpp"

namespace saccade {

/// "45 of 90 frames, 38.2/s, 1 s left", without the total and the time left if the total is unknown.
std::string progress_text(std::int64_t done, std::optional<std::int64_t> total, double elapsed_s);

/// "latency 34 ms (95 %: 41), 12 dropped": what matters of a live source.
std::string live_text(const Ledger& ledger, const DurationHistogram& latency);

/// A progress line on standard error that overwrites itself; silent unless that is a terminal.
class Progress {
 public:
  Progress(bool wanted, std::optional<std::int64_t> total);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Draws the line, at most ten times a second. `more` gives the text at its end and is called only then.
  void update(std::int64_t done, const std::function<std::string()>& more = {});

  /// Removes the line, before other text is printed.
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  std::optional<std::int64_t> total_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

}  // namespace saccade
