#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace saccade {

/// What SACCADE_VIRTUAL_DEVICE asks for: a source, and faults to order.
struct VirtualSpec {
  enum class Loss {
    event,   ///< OpenNI2 is told that the device is gone
    state,   ///< OpenNI2 is told that the device has an error
    silent,  ///< nothing is told; there are just no more frames
  };

  std::string source;                      ///< as open_source() takes it
  std::optional<std::int64_t> loss_after;  ///< loss_after=1..: so many frames after it appeared it is lost
  Loss loss = Loss::event;                 ///< loss=event | state | silent
  std::optional<std::chrono::milliseconds> back_after;  ///< back_after_ms=0..: after a loss; else never
  std::chrono::milliseconds late{0};   ///< late_ms=0..: it appears so long after OpenNI2 starts
  std::chrono::milliseconds stall{0};  ///< stall_ms=0..: nothing comes for so long,
  std::int64_t stall_after = 30;       ///< stall_after=1..: each time after so many frames
  std::int64_t short_frame = 0;   ///< short_frame=1..: each N-th depth frame has half its bytes; 0 = none
  std::optional<double> rate_hz;  ///< rate=0.1..1000: frames a second, whatever the mode says
  bool ignores_settings = false;  ///< ignores_settings=0 | 1: settings succeed and do nothing
};

/// Reads `SOURCE`, or `SOURCE?key=value&...`, or `SOURCE&key=value...`. A synthetic source keeps the keys
/// that are not of the virtual device. Throws Error (usage) for a key that nobody knows, one given twice, or
/// a bad value; it names what is expected.
VirtualSpec parse_virtual(const std::string& text);

/// The source that `source` means to somebody in `folder`: relative paths become absolute, all else stays.
std::string seen_from(const std::filesystem::path& folder, const std::string& source);

}  // namespace saccade
