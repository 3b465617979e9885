#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace saccade {

/// A device as OpenNI2 announces it.
struct DeviceIdentity {
  std::string uri, vendor, name;
  int usb_vendor = 0, usb_product = 0;  ///< 0 = not known
};

/// What OpenNI2 last complained of on this thread, in one line; never empty.
std::string openni2_complaint();

/// OpenNI2 as this process uses it: loaded with the first need, with its driver modules, and shut down at the
/// end of the program. Any thread.
class OpenNi2Runtime {
 public:
  /// Throws Error (failed) if OpenNI2 cannot start, e.g. for want of driver modules; the next call tries
  /// again.
  static OpenNi2Runtime& instance();

  /// What is connected now.
  std::vector<DeviceIdentity> devices() const;

  /// Counts how often the device was told to be gone or in error; a change means that it was lost.
  struct Trouble {
    std::int64_t count = 0;
    std::string text;  ///< the last one, for people
  };
  Trouble trouble(const std::string& uri) const;

  /// Changes with every device that comes, so that whoever waits looks again.
  std::int64_t arrivals() const;

  ~OpenNi2Runtime();
  OpenNi2Runtime(const OpenNi2Runtime&) = delete;
  OpenNi2Runtime& operator=(const OpenNi2Runtime&) = delete;

 private:
  OpenNi2Runtime();

  class Listener;
  std::unique_ptr<Listener> listener_;
};

/// Which of `devices` a source means that was asked for `wanted` (a URI; empty = any) and that had `last`
/// before, if any. On USB a sensor that is plugged in again gets another URI; so where the wanted one is not
/// there, the only device of the kind of `last` is taken for it. -1: none.
int choose_device(const std::vector<DeviceIdentity>& devices, const std::string& wanted,
                  const std::optional<DeviceIdentity>& last);

}  // namespace saccade
