#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace saccade {

/// "45 of 90 frames, 38.2/s, 1 s left"; the total and the time left only if the total is known.
std::string progress_text(std::int64_t done, std::optional<std::int64_t> total, double elapsed_s);

/// A progress line on standard error that overwrites itself; silent unless that is a terminal.
class Progress {
 public:
  Progress(bool wanted, std::optional<std::int64_t> total);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  std::optional<std::int64_t> total_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

}  // namespace saccade
