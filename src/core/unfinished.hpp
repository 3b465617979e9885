#pragma once

#include "core/error.hpp"

namespace saccade {

/// A further exit status: the work was interrupted, or is not complete; the same command goes on from there.
inline constexpr ExitStatus kUnfinished{4};

}  // namespace saccade
