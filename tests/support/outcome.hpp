#pragma once

#include <gtest/gtest.h>

#include "core/outcome.hpp"

namespace saccade {

/// For EXPECT_TRUE: a failed outcome prints its reason.
inline ::testing::AssertionResult succeeded(const Outcome& outcome) {
  return outcome ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << outcome.reason();
}

}  // namespace saccade
