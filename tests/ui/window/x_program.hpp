#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/folder_test.hpp"
#include "tests/ui/support/x_server.hpp"

namespace saccade {

/// A test that runs the viewer on an X server of its own and drives it with xdotool: mouse and keys. It
/// observes the viewer by its --ui-log. Skipped where Xvfb or xdotool is missing.
class XProgramTest : public FolderTest {
 protected:
  void SetUp() override;
  ~XProgramTest() override;

  /// Starts `saccade view` in the test's folder, with a log; waits up to a minute for its first frame.
  void start(const std::vector<std::string>& arguments);

  /// Runs the program to its end; returns the exit status. `display` = false: without any.
  int run(const std::vector<std::string>& arguments, bool display = true);

  /// The log, a line for each frame of the window.
  std::vector<nlohmann::json> lines() const;

  /// The newest line of the log.
  nlohmann::json now() const;

  /// Waits until the newest line of the log fulfils `condition`; a failure after a minute.
  ::testing::AssertionResult until(const std::function<bool(const nlohmann::json&)>& condition) const;

  /// Runs xdotool with these arguments.
  void xdotool(const std::string& words) const;

  /// Clicks a control of the window at a share (0..1) of its width.
  void click(const std::string& place, double across) const;
  void drag(const std::string& place, double from, double to) const;

  /// Waits for the end of the program that start() started; returns its exit status.
  int wait_for_exit();

  const std::string& display() const { return server_.display(); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

 private:
  pid_t spawn(const std::vector<std::string>& words, bool display) const;
  std::pair<int, int> place_of(const std::string& place, double across) const;
  void xdotool_and_wait(const std::string& words) const;

  XServer server_;
  pid_t program_ = -1;
};

}  // namespace saccade
