#pragma once

#include <stdexcept>
#include <string>

#include "core/error.hpp"

namespace saccade {

/// Calls `action`. Besides success, only an Error of this status and of one line is allowed; anything else
/// throws.
template <typename Action>
void proper_error_at_worst(ExitStatus status, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    if (error.status() != status || std::string(error.what()).find('\n') != std::string::npos)
      throw std::logic_error(std::string("not a proper error: ") + error.what());
  }
}

}  // namespace saccade
