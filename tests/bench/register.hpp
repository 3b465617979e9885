#pragma once

namespace saccade {

/// Registers the benchmarks of a program; each defines its own.
void register_benchmarks();

}  // namespace saccade
