#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace saccade {

/// The value of SACCADE_VIRTUAL_DEVICE: a source, and faults to inject.
struct VirtualSpec {
  enum class Loss {
    event,   ///< the device is reported as gone
    state,   ///< the device is reported to have an error
    silent,  ///< nothing is reported; there are no more frames
  };

  std::string source;                      ///< as open_source() takes it
  std::optional<std::int64_t> loss_after;  ///< loss_after=1..: frames from its appearance to its loss
  Loss loss = Loss::event;                 ///< loss=event | state | silent
  std::optional<std::chrono::milliseconds> back_after;  ///< back_after_ms=0..: after a loss; else never
  std::int64_t back_at =
      0;  ///< back_at=0..: frame of the source, for a device that is opened again after a loss
  std::chrono::milliseconds late{0};   ///< late_ms=0..: from the start of OpenNI2 to its appearance
  std::chrono::milliseconds stall{0};  ///< stall_ms=0..: for this time nothing arrives,
  std::int64_t stall_after = 30;       ///< stall_after=1..: after each N frames
  std::int64_t short_frame = 0;   ///< short_frame=1..: each N-th depth frame has half its bytes; 0 = none
  std::optional<double> rate_hz;  ///< rate=0.1..1000: frames per second, whatever the mode says
  bool ignores_settings = false;  ///< ignores_settings=0 | 1: settings succeed and do nothing
};

/// Reads `SOURCE`, or `SOURCE?key=value&...`, or `SOURCE&key=value...`. A synthetic source keeps the keys
/// that are not of the virtual device. Throws Error (usage) for an unknown key, one given twice, or a bad
/// value; it names what is expected.
VirtualSpec parse_virtual(const std::string& text);

/// `source` as written in `folder`: relative paths become absolute, all else stays.
std::string seen_from(const std::filesystem::path& folder, const std::string& source);

}  // namespace saccade
