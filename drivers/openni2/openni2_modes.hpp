#pragma once

#include <span>
#include <vector>

#include <OpenNI.h>

#include "core/sensor_settings.hpp"

namespace saccade {

/// A mode of a sensor, in Saccade's form and in OpenNI2's.
struct OfferedMode {
  SensorMode mode;
  openni::VideoMode original;
};

/// The modes of an open device in the formats that can be read, each once: depth in mm, then modes that exist
/// in 100 um only; colour as RGB. Empty if it has no such sensor.
std::vector<OfferedMode> depth_modes(openni::Device& device);
std::vector<OfferedMode> colour_modes(openni::Device& device);

std::vector<SensorMode> names_of(std::span<const OfferedMode> offered);
SensorMode to_mode(const openni::VideoMode& mode);

/// The position in `offered` of the mode that comes nearest to `wanted`, first by size, then by rate; -1 if
/// there is none.
int nearest_mode(std::span<const SensorMode> offered, const SensorMode& wanted);

}  // namespace saccade
