#pragma once

#include <functional>
#include <future>
#include <string>
#include <vector>

namespace saccade {

/// Asks on a thread of its own why no sensor can be used, as `saccade doctor` does. One thread at a time.
class SensorAdvice {
 public:
  using Ask = std::function<std::vector<std::string>()>;

  /// `ask` returns a line for each problem and its remedy; it may throw, and its error is the advice then.
  /// `wake` is called on any thread when there is an answer.
  SensorAdvice(Ask ask, std::function<void()> wake) : ask_(std::move(ask)), wake_(std::move(wake)) {}

  /// Asks again, unless a question is on its way.
  void ask();
  /// No advice is needed any more.
  void clear();
  bool active() const { return active_; }

  /// The newest answer; empty while there is none.
  [[nodiscard]] const std::vector<std::string>& poll();

 private:
  const Ask ask_;
  const std::function<void()> wake_;
  bool active_ = false;
  std::vector<std::string> advice_;
  std::future<std::vector<std::string>> answer_;
};

}  // namespace saccade
