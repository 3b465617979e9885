#pragma once

#include <string>
#include <vector>

#include "core/setting.hpp"

namespace saccade {

/// How the program runs, whatever it computes.
struct ProgramSettings {
  int workers = 0;  ///< threads that compute, 0..256; 0 = one per processor
  bool quiet = false;
  std::string log_level = "info";
};

std::vector<SettingOf<ProgramSettings>> program_setting_specs();

/// settings.workers, with 0 resolved to the number of processors.
int worker_count(const ProgramSettings& settings);

}  // namespace saccade
