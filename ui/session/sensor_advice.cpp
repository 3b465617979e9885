#include "ui/session/sensor_advice.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace saccade {

void SensorAdvice::ask() {
  active_ = true;
  if (answer_.valid()) return;
  answer_ = std::async(std::launch::async, [ask = ask_, wake = wake_]() -> std::vector<std::string> {
    std::vector<std::string> lines;
    try {
      lines = ask();
    } catch (const std::exception& error) {
      lines = {error.what()};
    }
    wake();
    return lines;
  });
}

void SensorAdvice::clear() {
  active_ = false;
  advice_.clear();
}

const std::vector<std::string>& SensorAdvice::poll() {
  if (answer_.valid() && answer_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    std::vector<std::string> lines = answer_.get();
    if (active_) advice_ = std::move(lines);
  }
  return advice_;
}

}  // namespace saccade
