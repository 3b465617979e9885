#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace saccade {

/// A sensor that is connected.
struct DeviceChoice {
  std::string name;    ///< for people
  std::string source;  ///< what opens it
  std::string detail;  ///< vendor, driver; or why it cannot be opened
  bool operator==(const DeviceChoice&) const = default;
};

/// Looks which sensors are connected, again and again on a thread of its own, while somebody wants to know.
/// Any thread.
class DeviceWatch {
 public:
  using List = std::function<std::vector<DeviceChoice>()>;

  /// `list` may throw; it is called on the watch's thread only. `changed` is called there after each look
  /// that found something else than the one before.
  DeviceWatch(List list, std::function<void()> changed,
              std::chrono::milliseconds period = std::chrono::seconds(1));
  ~DeviceWatch();
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// Whether it looks at all; it does not at first.
  void set_active(bool active);

  struct Seen {
    std::optional<std::vector<DeviceChoice>> devices;  ///< none = not looked yet
    std::string error;                                 ///< why they could not be listed; empty = they could
    bool operator==(const Seen&) const = default;
  };
  Seen seen() const;

 private:
  void work(const std::stop_token& token);
  Seen look() const;

  const List list_;
  const std::function<void()> changed_;
  const std::chrono::milliseconds period_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  bool active_ = false;  // guarded by mutex_
  Seen seen_;            // guarded by mutex_
  std::jthread thread_;
};

}  // namespace saccade
