#pragma once

#include <functional>

namespace saccade {

/// Calls work() once with each instruction set of this machine and build, from the highest to the lowest, and
/// names the set in failures. What Highway chose before is chosen again after.
void with_each_instruction_set(const std::function<void()>& work);

}  // namespace saccade
