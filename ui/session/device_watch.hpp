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
  std::string name;    ///< for lists and messages
  std::string source;  ///< SOURCE of the command line: "openni2:URI"
  std::string detail;  ///< vendor, driver; or why it cannot be opened
  bool operator==(const DeviceChoice&) const = default;
};

/// Lists the connected sensors periodically on a thread of its own. Any thread.
class DeviceWatch {
 public:
  using List = std::function<std::vector<DeviceChoice>()>;

  /// Calls `list`, which may throw, on the watch's thread only, and `changed` there after each listing that
  /// differs from the one before.
  DeviceWatch(List list, std::function<void()> changed,
              std::chrono::milliseconds period = std::chrono::seconds(2));
  ~DeviceWatch();
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  struct Seen {
    std::optional<std::vector<DeviceChoice>> devices;  ///< none = not listed yet
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
  Seen seen_;  // guarded by mutex_
  std::jthread thread_;
};

}  // namespace saccade
