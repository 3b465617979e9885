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

/// A test that runs the viewer on an X server of its own and uses it with xdotool, as a person would with
/// mouse and keys. What the viewer does is read from its --ui-log. Skipped where Xvfb or xdotool is missing.
class XProgramTest : public FolderTest {
 protected:
  void SetUp() override;
  ~XProgramTest() override;

  /// Starts `saccade view`, in the test's folder, with these arguments and the log; a minute for its first
  /// frame.
  void start(const std::vector<std::string>& arguments);

  /// Starts the program and waits for its end; the exit status. `display` = false: without any.
  int run(const std::vector<std::string>& arguments, bool display = true);

  /// The log: a line of each frame of the window.
  std::vector<nlohmann::json> lines() const;

  /// The newest line of the log.
  nlohmann::json now() const;

  /// Waits until a line of the log from now on fulfils `condition`; fails the test after a minute.
  ::testing::AssertionResult until(const std::function<bool(const nlohmann::json&)>& condition) const;

  /// xdotool with these words.
  void hand(const std::string& words) const;

  /// A click on a share (0..1) of the width of a thing in the window.
  void click(const std::string& place, double across) const;
  void drag(const std::string& place, double from, double to) const;

  /// The exit status of what start() started.
  int wait_for_exit();

  const std::string& display() const { return server_.display(); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

 private:
  pid_t spawn(const std::vector<std::string>& words, bool display) const;
  std::pair<int, int> place_of(const std::string& place, double across) const;
  void hand_and_wait(const std::string& words) const;

  XServer server_;
  pid_t program_ = -1;
};

}  // namespace saccade
