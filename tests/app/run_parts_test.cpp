// `saccade run` in parts: shards of a large job, and runs that go on after an interruption.

#include <algorithm>
#include <csignal>
#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

const std::string kScenes = "synthetic:table?seed=3&noise=kinect&size=160x120&frames=40&scenes=40";

class RunPartsTest : public ProgramTest {
 protected:
  std::vector<std::string> command(const std::string& out, std::vector<std::string> more = {},
                                   const std::string& source = kScenes) const {
    std::vector<std::string> arguments = {"run",    source,  "--out",   in(out), "--levels", "0..2",
                                          "--dump", "masks", "--start", "1",     "--every",  "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  json manifest(const std::string& out) const { return json::parse(text(out + "/manifest.json")); }

  // The files of a run but for its manifest.
  std::map<std::string, std::string> files(const std::string& out) const {
    std::map<std::string, std::string> all;
    for (const auto& file : fs::directory_iterator(folder_ / out))
      if (const std::string name = file.path().filename(); name != "manifest.json")
        all[name] = text(out + "/" + name);
    return all;
  }

  void expect_error(int status, const std::string& message, const std::vector<std::string>& arguments) const {
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_TRUE(outcome.one_error_line());
  }
};

TEST_F(RunPartsTest, ShardsOneAfterTheOtherAreTheWhole) {
  ASSERT_EQ(run_saccade(command("whole")).status, 0);
  std::map<std::string, std::string> joined;
  std::string lines;
  for (const std::string i : {"1", "2", "3", "4"}) {
    ASSERT_EQ(run_saccade(command(i, {"--shard", i + "/4"})).status, 0);
    EXPECT_EQ(manifest(i)["shard"], i + "/4");
    lines += text(i + "/fixations.jsonl");
    joined.merge(files(i));
  }
  joined["fixations.jsonl"] = lines;
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 13);
  EXPECT_EQ(joined, files("whole"));
}

TEST_F(RunPartsTest, JobsThatCannotBeDivided) {
  expect_error(kUsage, "i/n", command("out", {"--shard", "5/4"}));
  expect_error(kUsage, "13 frames cannot be divided into 14 shards", command("out", {"--shard", "1/14"}));
  const std::string sequence = "synthetic:table?size=160x120&frames=20&camera=orbit";
  expect_error(kUsage, "attention over time needs all frames", command("out", {"--shard", "1/2"}, sequence));
  EXPECT_EQ(run_saccade(command("out", {"--shard", "1/2", "--tracking", "off"}, sequence)).status, 0);
}

// Killed without a chance to finish anything, twice.
TEST_F(RunPartsTest, GoesOnAfterEveryKill) {
  const std::string many = "synthetic:table?seed=3&noise=kinect&size=320x240&frames=180&scenes=180";
  ASSERT_EQ(run_saccade(command("whole", {}, many)).status, 0);
  int kills = 0;
  for (const char* picture : {"parts/000037_masks.png", "parts/000091_masks.png"})
    kills +=
        run_saccade(command("parts", {"--resume"}, many), 0, folder_ / picture, SIGKILL).status == -SIGKILL;
  ASSERT_EQ(kills, 2);
  write_file(in("parts/fixations.jsonl"), text("parts/fixations.jsonl") + "{\"frame\":94,\"fix");
  const ProgramResult outcome = run_saccade(command("parts", {"--resume"}, many));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("frames processed already"));
  EXPECT_EQ(files("parts"), files("whole"));
  const json whole = manifest("whole"), parts = manifest("parts");
  EXPECT_EQ(parts["status"], "done");
  EXPECT_EQ(parts["ledger"], whole["ledger"]);
  EXPECT_GE(parts["resumed"], 20);
}

TEST_F(RunPartsTest, AnInterruptionIsNoSuccess) {
  const std::string many = "synthetic:table?size=160x120&frames=100000&scenes=100";
  const ProgramResult outcome = run_saccade(command("out", {"--resume"}, many), 0, in("out/fixations.jsonl"));
  EXPECT_EQ(outcome.status, kUnfinished);
  EXPECT_THAT(outcome.err, HasSubstr("the same command continues it"));
  EXPECT_EQ(manifest("out")["status"], "interrupted");
}

TEST_F(RunPartsTest, FramesThatWereRejectedStayCounted) {
  ASSERT_EQ(run_saccade({"export", kScenes, "--out", in("data"), "--quiet"}).status, 0);
  write_file(in("data/000004_depth.png"), std::string_view("no image"));
  ASSERT_EQ(run_saccade(command("whole", {}, in("data"))).status, 0);
  ASSERT_EQ(run_saccade(command("parts", {}, in("data"))).status, 0);
  json cut = manifest("parts");
  cut["status"] = "interrupted";
  write_file(in("parts/manifest.json"), cut.dump());
  ASSERT_EQ(run_saccade(command("parts", {"--resume"}, in("data"))).status, 0);
  EXPECT_EQ(files("parts"), files("whole"));
  EXPECT_EQ(manifest("parts")["ledger"], manifest("whole")["ledger"]);
  EXPECT_EQ(manifest("parts")["rejected"], manifest("whole")["rejected"]);
  EXPECT_EQ(manifest("parts")["rejected"].size(), 1U);
}

TEST_F(RunPartsTest, ACompleteRunIsLeftAlone) {
  ASSERT_EQ(run_saccade(command("out", {"--resume"})).status, 0);
  const auto before = fs::last_write_time(folder_ / "out/manifest.json");
  const ProgramResult outcome = run_saccade(command("out", {"--resume"}));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("complete already"));
  EXPECT_EQ(fs::last_write_time(folder_ / "out/manifest.json"), before);
}

TEST_F(RunPartsTest, OnlyTheSameRunGoesOn) {
  ASSERT_EQ(run_saccade(command("out")).status, 0);
  const auto before = files("out");
  expect_error(kUsage, "its kernel is 15, not 9", command("out", {"--resume", "--kernel", "9"}));
  expect_error(kUsage, "its source is", command("out", {"--resume"}, kScenes + "&rate=15"));
  expect_error(kUsage, "its shard is null, not \"1/2\"", command("out", {"--resume", "--shard", "1/2"}));
  EXPECT_EQ(run_saccade(command("out", {"--resume", "--workers", "1", "--quiet"})).status, 0);
  EXPECT_EQ(files("out"), before);
  write_file(in("out/manifest.json"), std::string_view("{}"));
  expect_error(kUnreadable, "not of a run", command("out", {"--resume"}));
  expect_error(kUsage, "attention over time",
               command("out", {"--resume"}, "synthetic:table?size=160x120&frames=9&camera=orbit"));
  expect_error(kUsage, "a data set (--dump depth)",
               {"run", kScenes, "--out", in("out"), "--resume", "--dump", "depth", "--levels", "0..2"});
}

// Numbers that are no frame of any run: some cannot be converted to an integer, others overflow.
TEST_F(RunPartsTest, FramesThatCannotBeAreRefused) {
  ASSERT_EQ(run_saccade(command("out")).status, 0);
  json cut = manifest("out");
  cut["status"] = "interrupted";
  write_file(in("out/manifest.json"), cut.dump());
  const std::string lines = text("out/fixations.jsonl");
  for (const std::string bad : {"1e300", "-1", "0.5", "9223372036854775807", "18446744073709551615"}) {
    write_file(in("out/fixations.jsonl"), lines + "{\"frame\":" + bad + "}\n{\"frame\":" + bad + "}\n");
    expect_error(kUnreadable, "not of a run", command("out", {"--resume"}));
    write_file(in("out/fixations.jsonl"), lines);
    json other = cut;
    other["rejected"] = {{{"frame", json::parse(bad)}, {"reason", "damaged"}}};
    write_file(in("out/manifest.json"), other.dump());
    expect_error(kUnreadable, "not of a run", command("out", {"--resume"}));
    write_file(in("out/manifest.json"), cut.dump());
  }
}

}  // namespace
}  // namespace saccade
