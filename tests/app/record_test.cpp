// `saccade record`: killed, interrupted, on a full disk.
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "oni/check.hpp"
#include "oni/recording.hpp"
#include "oni/repair.hpp"
#include "sources/open_source.hpp"
#include "tests/support/outcome.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;

// Integer millimetres with noise, so that every frame is different.
const std::string kSource = "synthetic:sphere?size=80x60&noise=kinect&frames=100000";

class RecordTest : public ProgramTest {
 protected:
  // Checks that the frames of the recording are the first ones of the source; returns their number.
  std::int64_t expect_frames_of_source(const std::string& file) {
    Recording recording{std::filesystem::path(file)};
    const OniNode* node = main_depth(recording);
    if (node == nullptr) return 0;
    const auto source = open_source(kSource);
    Frame frame;
    cv::Mat1f depth;
    for (std::size_t k = 0; k < node->frames.size(); ++k) {
      EXPECT_EQ(source->read(frame, std::chrono::milliseconds(0)).status, ReadStatus::frame);
      EXPECT_TRUE(succeeded(recording.read_depth(*node, k, depth)));
      EXPECT_EQ(cv::norm(depth, frame.depth_mm, cv::NORM_INF), 0) << "frame " << k;
    }
    return static_cast<std::int64_t>(node->frames.size());
  }

  bool sound(const std::string& file) {
    Recording recording{std::filesystem::path(file)};
    return is_sound(check_recording(recording));
  }
};

TEST_F(RecordTest, WritesTheRequestedNumberOfFramesAndReportsIt) {
  const ProgramResult outcome = run_saccade({"record", kSource, in("a.oni"), "--frames", "25", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(summary["frames"], 25);
  EXPECT_EQ(summary["dropped"], 0);
  EXPECT_EQ(summary["bytes"], std::filesystem::file_size(in("a.oni")));
  EXPECT_EQ(expect_frames_of_source(in("a.oni")), 25);
  EXPECT_TRUE(sound(in("a.oni")));
}

TEST_F(RecordTest, DurationIsRecordedTime) {
  for (const std::string codec : {"16zT", "16zP", "none"}) {
    ASSERT_EQ(run_saccade({"record", kSource, in("a.oni"), "--duration", "0.5", "--depth-codec", codec,
                           "--colour-codec", "off", "--force"})
                  .status,
              0);
    EXPECT_EQ(expect_frames_of_source(in("a.oni")), 15) << "at 30 frames a second";
  }
}

TEST_F(RecordTest, AnExistingFileIsKeptWithoutForce) {
  ASSERT_EQ(run_saccade({"record", kSource, in("a.oni"), "--frames", "3"}).status, 0);
  const ProgramResult again = run_saccade({"record", kSource, in("a.oni"), "--frames", "5"});
  EXPECT_EQ(again.status, 2);
  EXPECT_TRUE(again.one_error_line());
  EXPECT_EQ(expect_frames_of_source(in("a.oni")), 3);
  EXPECT_EQ(run_saccade({"record", kSource, in("a.oni"), "--frames", "5", "--force"}).status, 0);
  EXPECT_EQ(expect_frames_of_source(in("a.oni")), 5);
}

TEST_F(RecordTest, CtrlCAndTermCloseTheFile) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const ProgramResult outcome =
        run_saccade({"record", kSource, in("a.oni"), "--force"}, 150, in("a.oni"), signal);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("interrupted"));
    EXPECT_GT(expect_frames_of_source(in("a.oni")), 0);
    EXPECT_TRUE(sound(in("a.oni")));
    std::filesystem::remove(in("a.oni"));
  }
}

TEST_F(RecordTest, KilledAtAnyMomentTheFileHasItsFrames) {
  for (int k = 0; k < 20; ++k) {
    const ProgramResult outcome =
        run_saccade({"record", kSource, in("k.oni")}, 7 + 13 * k, in("k.oni"), SIGKILL);
    ASSERT_EQ(outcome.status, -SIGKILL);
    if (std::filesystem::file_size(in("k.oni")) < 24) {
      std::filesystem::remove(in("k.oni"));
      continue;  // killed before the first frame
    }
    const auto frames = expect_frames_of_source(in("k.oni"));
    if (frames > 0) {
      repair_recording(in("k.oni"), in("repaired.oni"), true);
      EXPECT_EQ(expect_frames_of_source(in("repaired.oni")), frames);
      EXPECT_TRUE(sound(in("repaired.oni")));
    }
    std::filesystem::remove(in("k.oni"));
  }
}

TEST_F(RecordTest, AFullDiskLeavesAClosedFileOfAllFramesBefore) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const rlim_t limit : {rlim_t{60'000}, rlim_t{100'001}, rlim_t{150'042}}) {
    rlimit small = before;
    small.rlim_cur = limit;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const ProgramResult outcome = run_saccade({"record", kSource, in("full.oni"), "--force"});
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(outcome.one_error_line());
    EXPECT_THAT(outcome.err, HasSubstr("disk full"));
    EXPECT_LE(std::filesystem::file_size(in("full.oni")), limit);
    EXPECT_GT(expect_frames_of_source(in("full.oni")), 5);
    EXPECT_TRUE(sound(in("full.oni")));
  }
}

TEST_F(RecordTest, AFullFileSystemLeavesAClosedFileOfAllFramesBefore) {
  const std::string disk = in("disk");
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=200k") != 0)
    GTEST_SKIP() << "no file system may be mounted here";
  const ProgramResult outcome = run_saccade({"record", kSource, disk + "/full.oni"});
  const std::int64_t frames = expect_frames_of_source(disk + "/full.oni");
  const bool is_sound = sound(disk + "/full.oni");
  ASSERT_EQ(::umount2(disk.c_str(), MNT_DETACH), 0);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.one_error_line());
  EXPECT_THAT(outcome.err, HasSubstr("disk full"));
  EXPECT_THAT(outcome.err, HasSubstr("closed with the " + std::to_string(frames) + " frames before"));
  EXPECT_GT(frames, 5);
  EXPECT_TRUE(is_sound);
}

TEST_F(RecordTest, BadArgumentsAreUsageErrorsAndLeaveNoFile) {
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"--frames", "-1"}, {"--depth-codec", "zip"}, {"--duration", "soon"}}) {
    std::vector<std::string> arguments = {"record", kSource, in("x.oni")};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(outcome.one_error_line());
  }
  EXPECT_EQ(run_saccade({"record", in("absent.oni"), in("x.oni")}).status, 3);
  EXPECT_EQ(run_saccade({"record", kSource, in("no/folder/x.oni"), "--frames", "1"}).status, 1);
  EXPECT_FALSE(std::filesystem::exists(in("x.oni")));
}

}  // namespace
}  // namespace saccade
