#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace saccade {

/// A test with its own folder, empty at the start and removed at the end. The folder is named after process,
/// suite and test, so that tests of one program, and those of two checkouts, may run at the same time.
class FolderTest : public ::testing::Test {
 protected:
  FolderTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FolderTest() override {
    std::error_code code;  // a destructor must not throw
    std::filesystem::remove_all(folder_, code);
  }

  const std::filesystem::path folder_ = [] {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        "saccade_" + std::to_string(::getpid()) + "_" + test->test_suite_name() + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');  // in the names of tests with parameters
    return std::filesystem::path(::testing::TempDir()) / name;
  }();
};

}  // namespace saccade
