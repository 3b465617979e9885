#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/setting.hpp"
#include "saliency/params.hpp"

namespace saccade {

/// Which model computes the saliency, and how. The operator's parameters matter to the models that need
/// depth; the others ignore them.
struct ModelSettings : Symmetry3dParams {
  std::string model = "symmetry3d";  ///< a name of models() (models/model.hpp)
  bool levels_chosen = false;        ///< false: the default levels, cut to those an image has room for
  std::string simd = "auto";         ///< highest instruction set of the operator, as in Symmetry3d
};

std::vector<SettingOf<ModelSettings>> model_setting_specs();

/// The last level to compute for an image of this size: levels that the user chose stay, and check_levels()
/// refuses them if they do not fit; the default levels are cut to those the image has room for. For an image
/// without room for any level, settings.last_level.
int last_level_for(const ModelSettings& settings, cv::Size image);

}  // namespace saccade
