#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/setting.hpp"
#include "output/overlay.hpp"
#include "saliency/symmetry3d.hpp"

namespace saccade {

/// What a command writes.
struct OutputSettings {
  std::set<std::string> dump = {"maps", "overlay"};  ///< files of each frame; see write_frame()
  bool json = false;                                 ///< a summary in JSON on standard output
  std::string stream{};    ///< where the lines of fixations.jsonl go as they come: "-" or "udp://HOST:PORT"
  OverlayStyle overlay{};  ///< of the overlay's picture
};

std::vector<SettingOf<OutputSettings>> output_setting_specs();

/// The by-products of the model that these files need.
RequestedOutputs requested_outputs(const OutputSettings& settings);

/// Throws Error (usage) if a file needs a by-product that the model does not have.
void check_dump(const OutputSettings& settings, std::string_view model);

}  // namespace saccade
