#include "x_program.hpp"
#include "tests/support/places.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

namespace saccade {
namespace {

using Json = nlohmann::json;

#ifdef __SANITIZE_THREAD__
constexpr auto kPatience = std::chrono::minutes(10);  // it makes the operator a hundred times slower
#else
constexpr auto kPatience = std::chrono::minutes(1);
#endif

int exit_status(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

void XProgramTest::SetUp() {
  for (const char* program : {"Xvfb", "xdotool"})
    if (!is_installed(program)) GTEST_SKIP() << program << " is not installed";
  ASSERT_TRUE(server_.start()) << "Xvfb did not start";
}

XProgramTest::~XProgramTest() {
  if (program_ <= 0) return;
  ::kill(program_, SIGTERM);
  exit_status(program_);
}

pid_t XProgramTest::spawn(const std::vector<std::string>& words, bool display) const {
  const pid_t child = ::fork();
  if (child != 0) return child;
  std::filesystem::current_path(folder_);  // what it writes goes there
  if (display)
    ::setenv("DISPLAY", server_.display().c_str(), 1);
  else
    ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  ::setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const int err = ::open((folder_ / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(err, STDERR_FILENO);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

int XProgramTest::run(const std::vector<std::string>& arguments, bool display) {
  std::vector<std::string> words = {saccade_program(), "view", "--ui-log", in("log")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return exit_status(spawn(words, display));
}

void XProgramTest::start(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {saccade_program(), "view", "--ui-log", in("log")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::filesystem::remove(folder_ / "log");  // of the last start
  program_ = spawn(words, true);
  ASSERT_TRUE(until([](const Json& line) { return line.contains("shown"); }));
  xdotool("search --onlyvisible --class saccade windowfocus --sync");
}

int XProgramTest::wait_for_exit() { return exit_status(std::exchange(program_, -1)); }

std::vector<Json> XProgramTest::lines() const {
  std::ifstream log(folder_ / "log");
  std::vector<Json> all;
  for (std::string line; std::getline(log, line);)
    if (!log.eof()) all.push_back(Json::parse(line, nullptr, false));  // the last may be on its way
  return all;
}

Json XProgramTest::now() const {
  std::ifstream log(folder_ / "log");
  std::string newest;
  for (std::string line; std::getline(log, line);)
    if (!log.eof()) newest.swap(line);
  return newest.empty() ? Json() : Json::parse(newest, nullptr, false);
}

::testing::AssertionResult XProgramTest::until(const std::function<bool(const Json&)>& condition) const {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  Json line;
  while (std::chrono::steady_clock::now() < end) {
    line = now();
    if (line.is_object() && condition(line)) return ::testing::AssertionSuccess();
    if (program_ > 0 && ::waitpid(program_, nullptr, WNOHANG) != 0)
      return ::testing::AssertionFailure() << "the program has ended";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return ::testing::AssertionFailure()
         << "not within " << kPatience.count() << " min; the last line: " << line.dump();
}

void XProgramTest::xdotool(const std::string& words) const {
  const std::string command = "DISPLAY=" + server_.display() + " xdotool " + words;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

std::pair<int, int> XProgramTest::place_of(const std::string& place, double across) const {
  const Json box = now()["places"][place];
  const double left = box[0], top = box[1], right = box[2], bottom = box[3];
  return {static_cast<int>(std::lround(left + (right - left) * across)),
          static_cast<int>(std::lround((top + bottom) / 2))};
}

void XProgramTest::xdotool_and_wait(const std::string& words) const {
  using namespace std::chrono_literals;
  // ImGui looks at the mouse once a frame, so that what is done and undone between two frames is not seen.
  const std::int64_t frames = now()["frames"];
  xdotool(words + " sleep 0.2");
  const auto end = std::chrono::steady_clock::now() + 5s;  // it may not draw: the mouse may be there already
  while (now()["frames"] < frames + 2 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(20ms);
}

void XProgramTest::click(const std::string& place, double across) const {
  // The target may still be moving.
  std::pair<int, int> aim{-1, -1};
  for (auto at = place_of(place, across); at != aim; at = place_of(place, across)) {
    aim = at;
    xdotool_and_wait("mousemove " + std::to_string(aim.first) + " " + std::to_string(aim.second));
  }
  xdotool_and_wait("mousedown 1");
  xdotool_and_wait("mouseup 1");
}

void XProgramTest::drag(const std::string& place, double from, double to) const {
  const auto [x0, y] = place_of(place, from);
  const int x1 = place_of(place, to).first;
  const std::string row = " " + std::to_string(y);
  xdotool_and_wait("mousemove " + std::to_string(x0) + row);
  xdotool_and_wait("mousedown 1");
  xdotool_and_wait("mousemove " + std::to_string((x0 + x1) / 2) + row);
  xdotool_and_wait("mousemove " + std::to_string(x1) + row);
  xdotool_and_wait("mouseup 1");
}

}  // namespace saccade
