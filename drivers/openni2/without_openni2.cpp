// Sensors in a build with SACCADE_OPENNI2=OFF: there are none, and the error says why.
#include "core/error.hpp"
#include "drivers/openni2/openni2_devices.hpp"
#include "drivers/openni2/openni2_installation.hpp"

namespace saccade {

std::vector<DeviceListing> list_devices() { throw not_in_this_build("OpenNI2", "SACCADE_OPENNI2"); }

void look_into(DeviceListing&) { throw not_in_this_build("OpenNI2", "SACCADE_OPENNI2"); }

OpenNi2Installation find_openni2(const std::filesystem::path&) {
  OpenNi2Installation none;
  none.in_this_build = false;
  none.left_out = {kOwnModules.begin(), kOwnModules.end()};
  return none;
}

}  // namespace saccade
