// `saccade run --stream`.
#include <algorithm>
#include <chrono>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class StreamTest : public ProgramTest {
 protected:
  ProgramResult shell(const std::string& command) const {
    return run_program("sh", {"-c", "P=" + saccade_program() + "; cd " + folder_.string() + "; " + command});
  }
  json manifest() const { return json::parse(text("o/manifest.json")); }
};

std::string run_of(int frames) {
  return fmt::format(
      "$P run 'synthetic:table?size=80x60&frames={}' --levels 0..1 --dump none --out o --stream ", frames);
}

TEST_F(StreamTest, StandardOutputHasALineForEachFrameAndNothingElse) {
  const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(
                          std::chrono::system_clock::now().time_since_epoch())
                          .count();
  const ProgramResult outcome = shell(run_of(20) + "-");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out), file(text("o/fixations.jsonl"));
  int count = 0;
  for (std::string line, stored; std::getline(lines, line) && std::getline(file, stored); ++count) {
    json streamed = json::parse(line);
    const auto captured = streamed["captured_us"].get<std::int64_t>();
    EXPECT_GE(captured, now_us);
    EXPECT_LT(captured, now_us + 600'000'000);
    streamed.erase("captured_us");
    EXPECT_EQ(streamed, json::parse(stored));
  }
  EXPECT_EQ(count, 20);
  EXPECT_THAT(outcome.err, HasSubstr("20 frames in")) << "the summary goes to standard error";
  EXPECT_EQ(manifest()["stream"]["sent"], 20);
}

TEST_F(StreamTest, AReaderThatLeavesEndsTheRunWithItsLedger) {
  const ProgramResult outcome =
      shell("(" + run_of(1'000'000) + "- 2> err; echo $? > status) | head -n 2 > lines");
  EXPECT_EQ(text("status"), "0\n") << text("err");
  EXPECT_EQ(manifest()["status"], "interrupted");
  EXPECT_TRUE(manifest()["stream"]["closed"].get<bool>());
  const json ledger = manifest()["ledger"];
  EXPECT_EQ(ledger["captured"].get<int>(), ledger["processed"].get<int>() + ledger["dropped"].get<int>());
  const std::string lines = text("lines");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
}

TEST_F(StreamTest, WrongUseIsOneLine) {
  for (const char* wrong : {"- --json", "udp://nowhere", "x"}) {
    const ProgramResult outcome = shell(run_of(2) + wrong);
    EXPECT_EQ(outcome.status, 2) << wrong;
    EXPECT_TRUE(outcome.one_error_line()) << outcome.err;
  }
}

}  // namespace
}  // namespace saccade
