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

/// OpenNI2's last error message on this thread, in one line; never empty.
std::string openni2_complaint();

/// OpenNI2 as this process uses it: loaded on first use, with its driver modules, and shut down at the end of
/// the program. Any thread.
class OpenNi2Runtime {
 public:
  /// Throws Error (failed) if OpenNI2 cannot start, e.g. without driver modules; a later call tries again.
  static OpenNi2Runtime& instance();

  /// The devices that are connected now.
  std::vector<DeviceIdentity> devices() const;

  /// Counts how often OpenNI2 reported the device as gone or in error; a change means that it was lost.
  struct Trouble {
    std::int64_t count = 0;
    std::string text;  ///< of the last report
  };
  Trouble trouble(const std::string& uri) const;

  /// Counts devices that appear: a change is a reason to look again.
  std::int64_t arrivals() const;

  ~OpenNi2Runtime();
  OpenNi2Runtime(const OpenNi2Runtime&) = delete;
  OpenNi2Runtime& operator=(const OpenNi2Runtime&) = delete;

 private:
  OpenNi2Runtime();

  class Listener;
  std::unique_ptr<Listener> listener_;
};

/// The position in `devices` of the one that a source uses which was opened for the URI `wanted` (empty =
/// any) and which used `last` before, if any. A USB sensor that is plugged in again gets another URI; so
/// where the wanted one is absent, the only device of the kind of `last` is taken. -1: none.
int choose_device(const std::vector<DeviceIdentity>& devices, const std::string& wanted,
                  const std::optional<DeviceIdentity>& last);

}  // namespace saccade
