#include "app/frame_problems.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/text.hpp"

namespace saccade {

void FrameProblems::add(std::int64_t index, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (count_++ > 0 && index > first_index_) return;
  first_index_ = index;
  first_reason_ = reason;
}

std::int64_t FrameProblems::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

std::string FrameProblems::first() const {
  const std::lock_guard lock(mutex_);
  return count_ == 0 ? std::string() : fmt::format("frame {}: {}", first_index_, first_reason_);
}

void report_incomplete(const std::string& source, const FrameProblems& frames) {
  const std::int64_t count = frames.count();
  if (count == 0) return;
  spdlog::warn("{}: {} without colour or labels that the source should have, the first, {}", source,
               counted(count, "frame"), frames.first());
}

}  // namespace saccade
