#include "drivers/openni2/openni2_modes.hpp"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <tuple>

namespace saccade {
namespace {

// `formats`: the better one first.
std::vector<OfferedMode> modes_of(openni::Device& device, openni::SensorType sensor,
                                  std::initializer_list<openni::PixelFormat> formats) {
  std::vector<OfferedMode> offered;
  const openni::SensorInfo* info = device.getSensorInfo(sensor);
  if (info == nullptr) return offered;
  const auto& all = info->getSupportedVideoModes();
  for (const openni::PixelFormat format : formats)
    for (int i = 0; i < all.getSize(); ++i) {
      const SensorMode mode = to_mode(all[i]);
      if (all[i].getPixelFormat() == format &&
          std::none_of(offered.begin(), offered.end(), [&](const auto& o) { return o.mode == mode; }))
        offered.push_back({mode, all[i]});
    }
  return offered;
}

}  // namespace

std::vector<OfferedMode> depth_modes(openni::Device& device) {
  return modes_of(device, openni::SENSOR_DEPTH,
                  {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM});
}

std::vector<OfferedMode> colour_modes(openni::Device& device) {
  return modes_of(device, openni::SENSOR_COLOR, {openni::PIXEL_FORMAT_RGB888});
}

std::vector<SensorMode> names_of(std::span<const OfferedMode> offered) {
  std::vector<SensorMode> modes;
  for (const OfferedMode& one : offered) modes.push_back(one.mode);
  return modes;
}

SensorMode to_mode(const openni::VideoMode& mode) {
  return {mode.getResolutionX(), mode.getResolutionY(), mode.getFps()};
}

int nearest_mode(std::span<const SensorMode> offered, const SensorMode& wanted) {
  const auto distance = [&](const SensorMode& mode) {
    return std::tuple(std::abs(mode.width - wanted.width) + std::abs(mode.height - wanted.height),
                      std::abs(mode.rate_hz - wanted.rate_hz));
  };
  const auto nearest = std::min_element(offered.begin(), offered.end(), [&](const auto& a, const auto& b) {
    return distance(a) < distance(b);
  });
  return nearest == offered.end() ? -1 : static_cast<int>(nearest - offered.begin());
}

}  // namespace saccade
