#include "app/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "core/text.hpp"

namespace saccade {
namespace {

bool can_overwrite_lines() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::string bar(double share) {
  constexpr int kWidth = 24;
  const int full = static_cast<int>(share * kWidth + 0.5);
  std::string text(kWidth, '.');
  std::fill_n(text.begin(), full, '#');
  return fmt::format("[{}] ", text);
}

}  // namespace

std::string progress_text(std::int64_t done, std::optional<std::int64_t> total, double elapsed_s) {
  const double rate = elapsed_s > 0 ? static_cast<double>(done) / elapsed_s : 0;
  if (!total || *total <= 0) return fmt::format("{}, {:.1f}/s", counted(done, "frame"), rate);
  std::string text = fmt::format("{} of {}, {:.1f}/s", done, counted(*total, "frame"), rate);
  if (rate > 0) text += fmt::format(", {:.0f} s left", static_cast<double>(*total - done) / rate);
  return text;
}

std::string live_text(const Ledger& ledger, const DurationHistogram& latency) {
  if (latency.count() == 0) return fmt::format("{} dropped", ledger.dropped);
  return fmt::format("latency {:.0f} ms (95 %: {:.0f}), {} dropped", latency.percentile_ms(0.5),
                     latency.percentile_ms(0.95), ledger.dropped);
}

Progress::Progress(bool wanted, std::optional<std::int64_t> total)
    : shown_(wanted && can_overwrite_lines()), total_(total) {}

void Progress::clear() const {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(std::int64_t done, const std::function<std::string()>& more) {
  if (!shown_) return;
  const auto now = Clock::now();
  const bool complete = total_ && done >= *total_;
  if (now - last_ < std::chrono::milliseconds(100) && !complete) return;
  last_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - begin_).count();
  const std::string picture =
      total_ && *total_ > 0 ? bar(static_cast<double>(done) / static_cast<double>(*total_)) : "";
  const std::string last = more ? more() : "";
  fmt::print(stderr, "\r\033[K{}{}{}{}", picture, progress_text(done, total_, elapsed_s),
             last.empty() ? "" : ", ", last);
  std::fflush(stderr);
}

}  // namespace saccade
