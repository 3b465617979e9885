#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/folder_test.hpp"

namespace saccade {

/// The exit statuses of the program (ExitStatus).
inline constexpr int kDone = 0, kFailed = 1, kUsage = 2, kUnreadable = 3, kUnfinished = 4;

/// A small SOURCE of two frames.
inline const std::string kSmallScene = "synthetic:table?frames=2&size=160x120";

/// The exit status and the output of a program.
struct ProgramResult {
  int status = -1;  ///< exit status; -signal if it was killed
  std::string out, err;

  /// Whether the error output is one line of the program.
  ::testing::AssertionResult one_error_line() const;
};

/// Runs the program under test. With interrupt_after_ms >= 0 sends it `signal` (SIGINT) that long after the
/// file `wait_for` has appeared.
ProgramResult run_saccade(const std::vector<std::string>& arguments, int interrupt_after_ms = -1,
                          const std::filesystem::path& wait_for = {}, int signal = 2);

/// Likewise any program, which is looked up in PATH if it is a name without a folder.
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          int interrupt_after_ms = -1, const std::filesystem::path& wait_for = {},
                          int signal = 2);

/// A test that runs the program in its own folder.
class ProgramTest : public FolderTest {
 protected:
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const;
};

}  // namespace saccade
