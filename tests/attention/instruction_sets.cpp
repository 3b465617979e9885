#include "instruction_sets.hpp"

#include <gtest/gtest.h>

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/targets.h>

namespace saccade {

void with_each_instruction_set(const std::function<void()>& work) {
  for (const std::int64_t set : hwy::SupportedAndGeneratedTargets()) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, hwy::TargetName(set));
    hwy::GetChosenTarget().Update(set);
    work();
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace saccade
