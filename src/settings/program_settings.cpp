#include "settings/program_settings.hpp"

#include "core/worker_pool.hpp"

namespace saccade {

std::vector<SettingOf<ProgramSettings>> program_setting_specs() {
  using S = ProgramSettings;
  return {
      number_setting<S>("workers", "N", "computing threads, at most 256; 0 = one per processor", &S::workers,
                        0, 256),
      switch_setting<S>("quiet", "print warnings and errors only: no progress, no summary", &S::quiet),
      word_setting<S>("log-level",
                      "least important messages to print: trace, debug, info, warn, error or off",
                      &S::log_level, {"trace", "debug", "info", "warn", "error", "off"}),
  };
}

int worker_count(const ProgramSettings& settings) {
  return settings.workers > 0 ? settings.workers : processor_count();
}

}  // namespace saccade
