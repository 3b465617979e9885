#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/folder_test.hpp"

namespace saccade {

/// How a program ended and what it wrote.
struct ProgramResult {
  int status = -1;  ///< exit status; -signal if it was killed
  std::string out, err;

  /// The error is one line of the program's own.
  ::testing::AssertionResult one_error_line() const;
};

/// Runs the program under test. With interrupt_after_ms >= 0 it gets `signal` (SIGINT) once the file
/// `wait_for` exists and that time has passed.
ProgramResult run_saccade(const std::vector<std::string>& arguments, int interrupt_after_ms = -1,
                          const std::filesystem::path& wait_for = {}, int signal = 2);

/// Likewise any program; finds it in PATH if it is a name alone.
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          int interrupt_after_ms = -1, const std::filesystem::path& wait_for = {},
                          int signal = 2);

/// A test that runs the program in a folder of its own.
class ProgramTest : public FolderTest {
 protected:
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const;
};

}  // namespace saccade
