#pragma once

#include <stdexcept>
#include <string>

#include "core/error.hpp"

namespace saccade {

/// Calls `action`; true if it succeeded. Besides that, only an Error of this status and of one line is
/// allowed; anything else throws.
template <typename Action>
bool proper_error_at_worst(ExitStatus status, const Action& action) {
  try {
    action();
    return true;
  } catch (const Error& error) {
    if (error.status() != status || std::string(error.what()).find('\n') != std::string::npos)
      throw std::logic_error(std::string("not a proper error: ") + error.what());
    return false;
  }
}

}  // namespace saccade
