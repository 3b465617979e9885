// Signals at moments that nobody chose: from the start of a program to the middle of its work.
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "oni/check.hpp"
#include "oni/recording.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AnyOf;

class SignalTest : public ProgramTest {
 protected:
  // Runs the program and sends it a signal at a random moment of its first second, or of the first second
  // after `file` is there. It must end soon: with this status, with 0 if it was done before, or by the signal
  // itself, as long as there is nothing to close. Returns the status.
  int interrupt(int status, const std::string& file, const std::vector<std::string>& arguments) {
    constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
    const int signal = kSignals[random_() % kSignals.size()], after_ms = static_cast<int>(random_() % 1000);
    const fs::path wait_for = random_() % 3 == 0 ? folder_ : folder_ / file;
    SCOPED_TRACE(arguments[0] + ", signal " + std::to_string(signal) + " after " + std::to_string(after_ms) +
                 " ms");
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult outcome = run_saccade(arguments, after_ms, wait_for, signal);
    // Two seconds where nothing else runs.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    EXPECT_THAT(outcome.status, AnyOf(status, 0, -signal)) << outcome.err;
    return outcome.status;
  }

  void expect_whole_lines(const std::string& name) const {
    if (!fs::exists(folder_ / name)) return;
    std::istringstream lines(text(name));
    for (std::string line; std::getline(lines, line);) EXPECT_TRUE(json::accept(line)) << line;
  }

  std::mt19937 random_{21};
};

constexpr int kMoments = 6;

TEST_F(SignalTest, RunLeavesWholeFilesAtAnyMoment) {
  for (int k = 0; k < kMoments; ++k) {
    fs::remove_all(folder_ / "o");
    const int status = interrupt(0, "o/fixations.jsonl",
                                 {"run", "synthetic:table?frames=100000&size=160x120", "--levels", "0..2",
                                  "--out", in("o"), "--dump", "maps", "--quiet"});
    expect_whole_lines("o/fixations.jsonl");
    if (status != 0) continue;
    const json manifest = json::parse(text("o/manifest.json"));
    EXPECT_EQ(manifest["status"], "interrupted");
    const std::string lines = text("o/fixations.jsonl");
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), manifest["ledger"]["processed"]);
    for (const auto& file : fs::directory_iterator(folder_ / "o")) {
      const std::string ending = file.path().extension();
      EXPECT_NE(ending, ".part");
      if (ending == ".png" || ending == ".tiff") {
        EXPECT_FALSE(cv::imread(file.path(), cv::IMREAD_UNCHANGED).empty()) << file;
      }
    }
  }
}

TEST_F(SignalTest, RecordLeavesASoundFileOrNoneAtAnyMoment) {
  for (int k = 0; k < kMoments; ++k) {
    fs::remove(folder_ / "a.oni");
    const int status = interrupt(
        0, "a.oni", {"record", "synthetic:sphere?frames=100000&size=160x120", in("a.oni"), "--quiet"});
    if (status != 0) continue;
    Recording recording(folder_ / "a.oni");
    EXPECT_TRUE(is_sound(check_recording(recording)));
  }
}

TEST_F(SignalTest, EvalCanBeContinuedAfterAnyMoment) {
  const std::vector<std::string> command = {"eval",     "synthetic:table?frames=30&size=160x120",
                                            "--levels", "0..2",
                                            "--points", "3",
                                            "--out",    in("o"),
                                            "--quiet"};
  constexpr int kInterrupted = 4;
  for (int k = 0; k < kMoments; ++k) {
    if (interrupt(kInterrupted, "o/results.jsonl", command) == 0)
      fs::remove_all(folder_ / "o");  // begin again
    expect_whole_lines("o/results.jsonl");
  }
  EXPECT_EQ(run_saccade(command).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "o/report.json"));
}

}  // namespace
}  // namespace saccade
