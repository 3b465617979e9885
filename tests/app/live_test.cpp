// `saccade run` and `saccade record` on a live source: slow processing, dropouts, Ctrl-C. The device is the
// virtual one, through OpenNI2 and our driver module.
#include <sched.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "oni/check.hpp"
#include "oni/recording.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class LiveTest : public ProgramTest {
 protected:
  // Sets the sensor that the program finds.
  static void plug_in(const std::string& faults) {
    const std::string device = "synthetic:table?size=160x120&noise=kinect&frames=5&scenes=5" + faults;
    ::setenv("SACCADE_VIRTUAL_DEVICE", device.c_str(), 1);
  }
  ~LiveTest() override { ::unsetenv("SACCADE_VIRTUAL_DEVICE"); }

  json manifest() const { return json::parse(text("out/manifest.json")); }

  std::int64_t lines(const std::string& name) const {
    const std::string all = text(name);
    return std::count(all.begin(), all.end(), '\n');
  }

  // Every frame is counted, and every result is in the files.
  void expect_complete() const {
    const json report = manifest(), ledger = report["ledger"];
    const auto of = [&](const char* key) { return ledger[key].get<std::int64_t>(); };
    EXPECT_EQ(of("captured"), of("processed") + of("dropped") + of("rejected"));
    EXPECT_EQ(lines("out/fixations.jsonl"), of("processed"));
    EXPECT_EQ(of("dropped"), report["dropped_by"]["newer_frame"].get<std::int64_t>() +
                                 report["dropped_by"]["end"].get<std::int64_t>());
  }
};

TEST_F(LiveTest, RunsTheRequestedNumberOfFramesAndReportsTheLatency) {
  plug_in("");
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--frames", "20", "--out", in("out"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["ledger"]["processed"], 20);
  EXPECT_GT(summary["latency_ms"]["p50"], 0);
  EXPECT_GE(summary["latency_ms"]["p99"], summary["latency_ms"]["p95"]);
  EXPECT_EQ(summary["device"]["state"], "streaming");
  EXPECT_EQ(manifest()["intrinsics"]["from"], "sensor");
  EXPECT_EQ(manifest()["source"]["kind"], "openni2");
  EXPECT_TRUE(std::filesystem::exists(in("out/000000_saliency.tiff")));
  expect_complete();
}

TEST_F(LiveTest, SlowProcessingDropsFramesInsteadOfFallingBehind) {
  plug_in("&rate=500");
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--mode", "80x60", "--frames", "15", "--out", in("out"), "--dump",
                   "none", "--simd", "scalar", "--workers", "1", "--kernel", "9", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  EXPECT_GT(summary["dropped_by"]["newer_frame"], 0) << "the device is faster";
  // On any machine, one of 15 frames takes about 1/15 of the run; with a queue it would take a large part.
  EXPECT_LT(summary["latency_ms"]["p95"].get<double>(), 1000 * summary["wall_s"].get<double>() / 3);
  expect_complete();
}

TEST_F(LiveTest, WaitsForALostDeviceAndCountsTheDropouts) {
  for (const std::string loss : {"event", "state"}) {
    plug_in("&loss_after=8&back_after_ms=50&loss=" + loss);
    const ProgramResult outcome =
        run_saccade({"run", "openni2", "--frames", "20", "--out", in("out"), "--dump", "none", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("is lost")) << loss;
    EXPECT_THAT(outcome.err, HasSubstr("reconnected"));
    const json device = json::parse(outcome.out)["device"];
    EXPECT_GE(device["losses"], 2);
    EXPECT_GT(device["away_s"], 0.05);
    expect_complete();
    std::filesystem::remove_all(in("out"));
  }
}

// Eight frames, a loss, and more frames of the same scene.
TEST_F(LiveTest, AttentionOverTimeRemembersTheSceneWhileTheDeviceIsLost) {
  ::setenv("SACCADE_VIRTUAL_DEVICE",
           "synthetic:table?size=160x120&noise=kinect&frames=5&loss_after=8&back_after_ms=300&loss=event", 1);
  const ProgramResult outcome = run_saccade({"run", "openni2", "--frames", "14", "--min-confidence", "0",
                                             "--out", in("out"), "--dump", "none", "--tracking", "on"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("reconnected"));
  EXPECT_EQ(manifest()["tracking"]["cuts"], 0);
  std::istringstream all(text("out/fixations.jsonl"));
  std::vector<json> frames;
  for (std::string line; std::getline(all, line);) frames.push_back(json::parse(line));
  std::size_t before = 0;  // the last frame before the longest gap
  const auto gap_us = [&](std::size_t k) {
    return frames[k + 1]["timestamp_us"].get<std::int64_t>() - frames[k]["timestamp_us"].get<std::int64_t>();
  };
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)
    if (gap_us(k) > gap_us(before)) before = k;
  ASSERT_GT(gap_us(before), 200'000);
  for (std::size_t rank = 0; rank < 3; ++rank) {
    const json &old = frames[before]["fixations"][rank], &now = frames[before + 1]["fixations"][rank];
    EXPECT_EQ(now["id"], old["id"]) << rank;
    EXPECT_GT(now["age_frames"], old["age_frames"]) << rank;
  }
}

// A folder with six frames of one table and six of another. The device is lost for more than a second after
// the first six, and comes back with the same table or with the other one.
TEST_F(LiveTest, AfterALossOnlyAnotherSceneIsACut) {
  namespace fs = std::filesystem;
  const auto write_table = [&](int seed, int start, const std::string& folder) {
    const std::string table =
        fmt::format("synthetic:table?size=320x240&noise=kinect&seed={}&frames={}", seed, start + 6);
    ASSERT_EQ(run_saccade({"export", table, "--start", std::to_string(start), "--out", in(folder)}).status,
              0);
  };
  write_table(3, 0, "tables");
  write_table(4, 6, "other");
  for (const auto& file : fs::directory_iterator(in("other")))
    if (file.path().extension() == ".png") fs::copy(file.path(), in("tables"));
  for (const char* name : {"times.txt", "poses.txt"}) fs::remove(in("tables") + "/" + name);
  for (const int back_at : {0, 6}) {
    const std::string device =
        fmt::format("{}?loss_after=6&back_after_ms=1300&back_at={}", in("tables"), back_at);
    ::setenv("SACCADE_VIRTUAL_DEVICE", device.c_str(), 1);
    const std::string out = fmt::format("out{}", back_at);
    const ProgramResult outcome = run_saccade({"run", "openni2", "--frames", "8", "--min-confidence", "0",
                                               "--out", in(out), "--dump", "none", "--tracking", "on"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("reconnected"));
    EXPECT_EQ(json::parse(text(out + "/manifest.json"))["tracking"]["cuts"], back_at == 0 ? 0 : 1);
    std::istringstream lines(text(out + "/fixations.jsonl"));
    std::set<int> before, after;  // ids in the first and in the last frame
    for (std::string line; std::getline(lines, line);) {
      after.clear();
      const json frame = json::parse(line);
      for (const json& fixation : frame["fixations"]) after.insert(fixation["id"].get<int>());
      if (before.empty()) before = after;
    }
    std::set<int> kept;
    std::set_intersection(before.begin(), before.end(), after.begin(), after.end(),
                          std::inserter(kept, kept.end()));
    if (back_at == 0)
      EXPECT_GE(2 * kept.size(), before.size()) << "ids survive the loss";
    else
      EXPECT_TRUE(kept.empty()) << "another scene has new ids";
  }
}

TEST_F(LiveTest, ASilentDeviceIsNoticed) {
  plug_in("&loss_after=5&loss=silent&back_after_ms=2300");
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--frames", "8", "--out", in("out"), "--dump", "none", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no depth for 2 s"));
  EXPECT_GE(json::parse(outcome.out)["device"]["losses"], 1);
}

// The frames that wait for the processing must neither hide the silence nor be lost in it.
TEST_F(LiveTest, ASilentDeviceIsNoticedWhileProcessingIsSlowerThanTheDevice) {
  plug_in("&rate=500&loss_after=100&loss=silent&back_after_ms=2300");
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--mode", "80x60", "--frames", "105", "--out", in("out"), "--dump",
                   "none", "--simd", "scalar", "--workers", "1", "--kernel", "9", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no depth for 2 s"));
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["ledger"]["processed"], 105);
  EXPECT_GT(summary["dropped_by"]["newer_frame"], 0) << "the device is faster";
  EXPECT_GE(summary["device"]["losses"], 1);
  EXPECT_GT(summary["device"]["away_s"], 0.2);
  expect_complete();
}

TEST_F(LiveTest, WithoutReconnectLosingTheDeviceIsAnError) {
  plug_in("&loss_after=8&loss=event&back_after_ms=50");
  const ProgramResult outcome = run_saccade({"run", "openni2", "--mode", "160x120", "--frames", "20", "--out",
                                             in("out"), "--dump", "none", "--no-reconnect"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.one_error_line());
  EXPECT_EQ(manifest()["status"], "failed");
  expect_complete();
}

TEST_F(LiveTest, ADeviceMayComeLate) {
  plug_in("&late_ms=300");
  const ProgramResult outcome = run_saccade(
      {"run", "openni2", "--mode", "160x120", "--frames", "3", "--out", in("out"), "--dump", "none"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(manifest()["intrinsics"]["from"], "sensor") << "though it was not known at the start";
}

TEST_F(LiveTest, ARelativePathOfADeviceStartsAtTheWorkingDirectory) {
  bool allowed = false;
  std::thread([&allowed] { allowed = ::unshare(CLONE_FS) == 0; }).join();
  if (!allowed) GTEST_SKIP() << "threads may not have a working directory of their own here";
  std::filesystem::copy(in_source("recordings/table.oni"), in("a.oni"));
  ::setenv("SACCADE_VIRTUAL_DEVICE", "a.oni", 1);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--frames", "2", "--out", "out", "--dump", "none"});
  std::filesystem::current_path(before);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(lines("out/fixations.jsonl"), 2) << "in the same folder";
}

TEST_F(LiveTest, NoDeviceIsOneLine) {
  ::unsetenv("SACCADE_VIRTUAL_DEVICE");
  for (const char* wait : {"0", "0.3"}) {
    const ProgramResult outcome = run_saccade({"run", "openni2", "--wait", wait, "--out", in("out")});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_TRUE(outcome.one_error_line());
    EXPECT_THAT(outcome.err, HasSubstr("saccade doctor"));
  }
}

TEST_F(LiveTest, ShortFramesAreRejectedAndNamed) {
  plug_in("&short_frame=4");
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--frames", "12", "--out", in("out"), "--dump", "none"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = manifest();
  EXPECT_GE(report["ledger"]["rejected"], 3);
  EXPECT_THAT(report["rejected"][0]["reason"].get<std::string>(), HasSubstr("19200 bytes, not 38400"));
  expect_complete();
}

TEST_F(LiveTest, SettingsThatTheDeviceIgnoresAreReported) {
  plug_in("&ignores_settings=1");
  const ProgramResult outcome =
      run_saccade({"run", "openni2", "--mirror", "--exposure", "20", "--white-balance", "fixed", "--frames",
                   "2", "--out", in("out"), "--dump", "none"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* setting : {"mirroring", "registration", "automatic exposure", "exposure was set to 20",
                              "automatic white balance"})
    EXPECT_THAT(outcome.err, HasSubstr(setting));
  EXPECT_EQ(run_saccade({"run", "openni2", "--mode", "1x1@30", "--out", in("no")}).status, 2);
}

TEST_F(LiveTest, SettingsThatALateOrReconnectedDeviceIgnoresAreReported) {
  plug_in("&ignores_settings=1&late_ms=300&loss_after=4&back_after_ms=50");
  const ProgramResult outcome = run_saccade({"run", "openni2", "--mode", "160x120", "--mirror", "--frames",
                                             "12", "--out", in("out"), "--dump", "none", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string what = "mirroring was turned on";
  const auto place = outcome.err.find(what);
  ASSERT_NE(place, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(what, place + 1), std::string::npos) << "once, not with each loss";
  const json device = json::parse(outcome.out)["device"];
  EXPECT_GE(device["losses"], 1);
  EXPECT_THAT(device["notes"].dump(), HasSubstr(what));
}

TEST_F(LiveTest, InterruptedAtAnyMomentItEndsSoonWithCompleteFiles) {
  plug_in("&loss_after=20&back_after_ms=120");
  for (int k = 0; k < 12; ++k) {
    std::filesystem::remove_all(in("out"));
    const auto begin = std::chrono::steady_clock::now();
    const int after_ms = 5 + 83 * k;
    const ProgramResult outcome = run_saccade({"run", "openni2", "--out", in("out"), "--dump", "maps"},
                                              after_ms, in("out/manifest.json"), k % 2 ? SIGTERM : SIGINT);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << "it does not hang";
    EXPECT_EQ(manifest()["status"], "interrupted");
    expect_complete();
  }
}

TEST_F(LiveTest, RecordsEveryFrameAcrossALoss) {
  plug_in("&loss_after=15&back_after_ms=100");
  const ProgramResult outcome = run_saccade({"record", "openni2", in("a.oni"), "--frames", "30", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["frames"], 30);
  EXPECT_EQ(summary["dropped"], 0);
  EXPECT_GE(summary["device"]["losses"], 1);
  Recording recording{std::filesystem::path(in("a.oni"))};
  EXPECT_TRUE(is_sound(check_recording(recording)));
  const OniNode* depth = main_depth(recording);
  ASSERT_NE(depth, nullptr);
  ASSERT_EQ(depth->frames.size(), 30U);
}

TEST_F(LiveTest, FramesThatCannotBeRecordedAreCountedInOneLine) {
  plug_in("&short_frame=3");
  const ProgramResult outcome =
      run_saccade({"record", "openni2", in("a.oni"), "--mode", "160x120", "--frames", "10", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GE(json::parse(outcome.out)["rejected"], 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("frames rejected, the first, frame"));
}

TEST_F(LiveTest, RecordingEndsWithACompleteFileWhenTheDeviceIsGone) {
  plug_in("&loss_after=10");
  const ProgramResult outcome = run_saccade({"record", "openni2", in("a.oni"), "--no-reconnect"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("closed with the"));
  Recording recording{std::filesystem::path(in("a.oni"))};
  EXPECT_TRUE(is_sound(check_recording(recording)));
}

}  // namespace
}  // namespace saccade
