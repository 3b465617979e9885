#pragma once

#include <string>
#include <vector>

#include "core/setting.hpp"

namespace saccade {

/// How the files of a source are understood, where they do not say it or say it wrongly.
struct InputSettings {
  double depth_unit_mm = 0;  ///< mm of one unit of stored depth; 0 = as the source says
  /// Of recordings with several: the names of the topics of depth, colour and camera; empty = by type and
  /// name.
  std::string depth_topic{}, colour_topic{}, camera_topic{};
};

std::vector<SettingOf<InputSettings>> input_setting_specs();

}  // namespace saccade
