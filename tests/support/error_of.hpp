#pragma once

#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace saccade {

/// The text of the Error that `action` throws; the test fails if none comes, or one with another status.
template <typename Action>
std::string error_of(ExitStatus status, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error came";
  return "";
}

}  // namespace saccade
