// Every command with inputs that it cannot use: one line of error, the right exit status, in bounded time and
// memory.
#include <sys/stat.h>

#include <chrono>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/folder_lock.hpp"
#include "core/png.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

class WrongInputs : public ProgramTest {
 protected:
  // Runs a shell command, in which "$P" is the program, in the folder of the test.
  ProgramResult shell(const std::string& command) const {
    return run_program(
        "bash", {"-c", fmt::format("P='{}'; cd '{}'; {}", saccade_program(), folder_.string(), command)});
  }

  void expect(int status, const std::string& part, const std::string& command) const {
    SCOPED_TRACE(command);
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult outcome = shell(command);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_TRUE(outcome.one_error_line());
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_THAT(outcome.err, Not(AnyOf(HasSubstr("unexpected"), HasSubstr("json.exception"))));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
  }

  void put(const std::string& name, std::string_view content) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, content);
  }
  void put_depth(const std::string& name, int value = 1000) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, encode_png(cv::Mat1w(120, 160, static_cast<std::uint16_t>(value))));
  }
};

TEST_F(WrongInputs, SourcesOfEveryCommandThatTakesOne) {
  put("text.mkv", "no video");
  put("text.oni", "no recording, but long enough to be one");
  put("text.mat", "no HDF5");
  put("text.txt", "text");
  put("list/depth.txt", "nonsense\n");
  put("empty/notes", "");
  put("meta/meta.json", std::string(1 << 21, '['));
  put_depth("meta/0_depth.png");
  ASSERT_EQ(::mkfifo((folder_ / "pipe_depth.mkv").c_str(), 0600), 0);
  const std::string long_name(30'000, 'x');
  for (const char* command : {"run {} --out o", "eval {} --out o", "record {} o.oni"}) {
    const auto with = [&](const std::string& source) {
      return "$P " + fmt::format(fmt::runtime(command), source);
    };
    for (const char* name : {"text.mkv", "text.oni", "text.mat", "text.txt", "list", "empty", "meta",
                             "absent.oni", "'none_%04d.png'", "pipe_depth.mkv", "/dev/zero", "/dev/null"})
      expect(kUnreadable, "", with(name));
    expect(kUnreadable, "no such source", with(long_name));
    expect(kUnreadable, "", with(long_name + "_%04d.png"));
    expect(kUsage, "", with("'synthetic:table?size=8192x8192'"));
    expect(kUsage, "", with("'synthetic:nowhere'"));
    EXPECT_FALSE(fs::exists(folder_ / "o.oni"));
  }
}

// Each thing is said once: what a file is called, and which frame it is.
TEST_F(WrongInputs, ReasonsDoNotRepeatThemselves) {
  fs::create_directories(folder_ / "d/0_depth.png");
  const std::string unreadable = in("d/0_depth.png");
  expect(kUnreadable, "saccade: cannot read: Is a directory: " + unreadable + " (",
         "$P run " + in("d") + " --out o");
  put_depth("d/1_depth.png");
  const ProgramResult run = shell("$P run " + in("d") + " --levels 0..2 --quiet --out o");
  EXPECT_EQ(run.status, kDone);
  EXPECT_THAT(run.err, HasSubstr("frame 0: cannot read: Is a directory: " + unreadable + " ("));

  ASSERT_EQ(shell("$P export '" + kSmallScene + "' --out v --format video --quiet").status, kDone);
  const auto size = fs::file_size(folder_ / "v/frames_depth.mkv");
  fs::resize_file(folder_ / "v/frames_depth.mkv", size - 2000);
  const ProgramResult video = shell("$P export v/frames_depth.mkv --out w");
  EXPECT_EQ(video.status, kDone);
  EXPECT_THAT(video.err, HasSubstr("1 frame rejected, the first, frame 1: the image is"));
}

// What a source notes comes with its first frame, so that the reason is the only line.
TEST_F(WrongInputs, WithoutAUsableFrameTheReasonIsTheOnlyLine) {
  put_depth("d/0_depth.png");
  fs::resize_file(folder_ / "d/0_depth.png", 60);
  for (const char* command : {"run d --levels 0..2 --out o", "export d --out e", "record d o.oni"})
    expect(kUnreadable, "0_depth.png: not a valid PNG", fmt::format("$P {}", command));
  EXPECT_FALSE(fs::exists(folder_ / "o.oni"));
}

TEST_F(WrongInputs, Outputs) {
  ASSERT_EQ(shell("$P record '" + kSmallScene + "' a.oni --quiet").status, kDone);
  const std::string recording = text("a.oni");
  expect(kUsage, "own source", "$P record a.oni a.oni --force");
  EXPECT_EQ(text("a.oni"), recording);
  expect(kUsage, ".oni", "$P record a.oni b.mkv");
  EXPECT_FALSE(fs::exists(folder_ / "b.mkv"));
  expect(kUsage, "name a folder", "$P run a.oni --levels 0..2 --out -");
  expect(kUsage, "name a folder", "$P eval '" + kSmallScene + "' --levels 0..2 --out -");
  for (const char* command :
       {"run a.oni --levels 0..2 --out o", "run a.oni --levels 0..2 --out o --json",
        "record a.oni b.oni --force", "record a.oni b.oni --force --json", "oni info a.oni",
        "oni check a.oni --json", "doctor", "doctor --json", "--help", "--version"})
    expect(kFailed, "standard output", fmt::format("$P {} >/dev/full", command));
  put("c/fixations.jsonl", "");
  put("precious", "precious");
  fs::remove(folder_ / "c/fixations.jsonl");
  fs::create_symlink("../precious", folder_ / "c/fixations.jsonl");
  expect(kFailed, "symbolic link", "$P run a.oni --levels 0..2 --out c");
  EXPECT_EQ(text("precious"), "precious");
}

// saccade --help | head: the reader is gone before anything is written. Who reads results should get them.
TEST_F(WrongInputs, AReaderOfHelpMayLeave) {
  ASSERT_EQ(shell("$P record '" + kSmallScene + "' a.oni --quiet").status, kDone);
  const auto read_nothing = [&](const char* command) {
    ASSERT_EQ(shell(fmt::format("{{ sleep 0.2; $P {} 2>errors; echo $? >status; }} | true", command)).status,
              0);
  };
  for (const char* command : {"--help", "run --help", "--version", "settings --default"}) {
    SCOPED_TRACE(command);
    read_nothing(command);
    EXPECT_EQ(text("status"), "0\n");
    EXPECT_EQ(text("errors"), "");
  }
  for (const char* command : {"oni info a.oni", "run a.oni --levels 0..2 --out o --json"}) {
    SCOPED_TRACE(command);
    read_nothing(command);
    EXPECT_EQ(text("status"), "1\n");
    EXPECT_THAT(text("errors"), HasSubstr("Broken pipe: standard output"));
  }
  EXPECT_TRUE(fs::exists(folder_ / "o/manifest.json"));
}

TEST_F(WrongInputs, ResultsThatAreMerged) {
  put("r/results.jsonl", "{}\n");
  expect(kUnreadable, "results.jsonl:1", "$P eval --merge r --out o");
  put("r/results.jsonl", std::string(20 << 20, '['));
  expect(kUnreadable, "results.jsonl", "$P eval --merge r --out o");
  fs::create_directories(folder_ / "closed");
  expect(kUnreadable, "", "$P eval --merge closed --out o");
}

TEST_F(WrongInputs, NamesThatAreNotPrintable) {
  const std::string name = "a\x1b[31m\nb\xff";
  put(name + ".mkv", "no video");
  expect(kUnreadable, "a\\x1b[31m b\\xff", fmt::format("$P run '{}.mkv' --out o", name));
  put_depth(name + "/0_depth.png");
  const ProgramResult outcome =
      shell(fmt::format("$P run '{}' --levels 0..2 --out '{} out' --json", name, name));
  EXPECT_EQ(outcome.status, kDone) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("\x1b")));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
      << "the guessed camera: " << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["ledger"]["processed"], 1);
  const ProgramResult plain = shell(fmt::format("$P run '{}' --levels 0..2 --out '{} out' 2>&1", name, name));
  EXPECT_THAT(plain.out, AllOf(HasSubstr("\\x1b"), Not(HasSubstr("\x1b"))));
}

TEST_F(WrongInputs, ClosedStandardStreams) {
  for (const char* closed : {">&-", "<&- >&- 2>&-", "2>&-"}) {
    SCOPED_TRACE(closed);
    EXPECT_EQ(shell("$P record '" + kSmallScene + "' a.oni --force " + closed).status, kDone);
    EXPECT_EQ(shell("$P oni check a.oni").status, kDone) << "nothing was written into it";
    EXPECT_EQ(shell("$P run a.oni --levels 0..2 --out o " + std::string(closed)).status, kDone);
    const std::string lines = text("o/fixations.jsonl");
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
    EXPECT_TRUE(lines.starts_with("{\"frame\":0"));
  }
}

TEST_F(WrongInputs, TwoProcessesInOneFolder) {
  // The second finds the lock of the first, which works for some seconds.
  const ProgramResult outcome = shell(
      "$P run 'synthetic:room?frames=300' --out o --quiet & first=$!;"
      "until [ -e o/fixations.jsonl ] || ! kill -0 $first; do sleep 0.05; done;"
      "$P run 'synthetic:table?frames=2&size=160x120' --levels 0..2 --out o; a=$?;"
      "$P eval 'synthetic:table?frames=2&size=160x120' --levels 0..2 --out o; b=$?;"
      "kill -INT $first; wait $first; echo $a $b $?");
  EXPECT_EQ(outcome.out, "1 1 0\n");
  EXPECT_THAT(outcome.err, HasSubstr("the folder is in use by saccade run, process "));
  EXPECT_FALSE(fs::exists(folder_ / "o/.saccade.lock"));
  EXPECT_EQ(nlohmann::json::parse(text("o/manifest.json"))["status"], "interrupted");
}

TEST_F(WrongInputs, AFolderInUseIsLeftAlone) {
  ASSERT_EQ(shell("$P eval '" + kSmallScene + "' --levels 0..2 --quiet --out shard").status, kDone);
  fs::create_directory(folder_ / "o");
  const FolderLock lock(folder_ / "o", "the test");
  const std::string orbit = "'synthetic:table?frames=2&size=160x120&camera=orbit'";
  for (const std::string& command :
       {"run '" + kSmallScene + "' --levels 0..2", "eval '" + kSmallScene + "' --levels 0..2",
        "eval " + orbit + " --levels 0..2 --over-time", std::string("eval --merge shard")})
    expect(kFailed, "the folder is in use by the test, process ", "$P " + command + " --quiet --out o");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "o"), {}), 1) << "the lock";
}

TEST_F(WrongInputs, AnOutputFolderThatIsDeletedMeanwhile) {
  const ProgramResult outcome = shell(
      "$P run 'synthetic:room?frames=3000' --out o --dump none & first=$!;"
      "until [ -s o/fixations.jsonl ] || ! kill -0 $first; do sleep 0.05; done; rm -r o; wait $first; echo "
      "$?");
  EXPECT_EQ(outcome.out, "1\n");
  EXPECT_THAT(outcome.err, HasSubstr("deleted"));
}

TEST_F(WrongInputs, AShorterRunLeavesNoPicturesOfTheOneBefore) {
  const std::string options =
      " --levels 0..2 --dump maps,levels,overlay,normals,masks,labels --quiet --out o";
  ASSERT_EQ(shell("$P run 'synthetic:table?frames=3&size=160x120'" + options).status, kDone);
  EXPECT_TRUE(fs::exists(folder_ / "o/000002_level1.tiff"));
  put("o/notes_saliency.png", "of the user");
  ASSERT_EQ(shell("$P run '" + kSmallScene + "' --levels 0..2 --quiet --out o").status, kDone);
  std::set<std::string> names;
  for (const auto& file : fs::directory_iterator(folder_ / "o"))
    names.insert(file.path().filename().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre(
                         "000000_overlay.png", "000000_saliency.png", "000000_saliency.tiff",
                         "000001_overlay.png", "000001_saliency.png", "000001_saliency.tiff",
                         "fixations.jsonl", "manifest.json", "notes_saliency.png"));
}

TEST_F(WrongInputs, FramesThatAModelCannotUseAreRejected) {
  for (int k = 0; k < 4; ++k) put_depth(fmt::format("d/{}_depth.png", k));
  write_file(folder_ / "d/1_rgb.png", encode_png(cv::Mat3b(120, 160, cv::Vec3b(9, 8, 7))));
  const ProgramResult outcome = shell("$P run d --levels 0..2 --model itti --selector wta --out o --json");
  EXPECT_EQ(outcome.status, kDone) << outcome.err;
  const auto ledger = nlohmann::json::parse(outcome.out)["ledger"];
  EXPECT_EQ(ledger["captured"], 4);
  EXPECT_EQ(ledger["processed"], 1);
  EXPECT_EQ(ledger["rejected"], 3);
  const auto rejected = nlohmann::json::parse(text("o/manifest.json"))["rejected"];
  ASSERT_EQ(rejected.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(rejected[i]["frame"], std::vector<int>({0, 2, 3})[i]);
  EXPECT_THAT(rejected[0]["reason"].get<std::string>(), HasSubstr("needs colour"));
}

TEST_F(WrongInputs, AHungUpTerminalEndsLikeTermination) {
  const ProgramResult recorded = run_saccade(
      {"record", "synthetic:sphere?size=80x60&frames=100000", in("a.oni")}, 300, in("a.oni"), SIGHUP);
  EXPECT_EQ(recorded.status, kDone) << recorded.err;
  EXPECT_EQ(shell("$P oni check a.oni").status, kDone);
  const ProgramResult run =
      run_saccade({"run", "synthetic:room?frames=3000", "--out", in("o"), "--dump", "none"}, 300,
                  in("o/fixations.jsonl"), SIGHUP);
  EXPECT_EQ(run.status, kDone) << run.err;
  EXPECT_EQ(nlohmann::json::parse(text("o/manifest.json"))["status"], "interrupted");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Both need more address space than any limit.
TEST_F(WrongInputs, TooLittleMemoryIsAnErrorAtEveryLimit) {
  put_depth("d/0_depth.png");
  put_depth("d/1_depth.png");
  ASSERT_EQ(shell("$P record 'synthetic:room?frames=2' a.oni --quiet").status, kDone);
  int failed = 0, done = 0;
  for (const char* command :
       {"run d --levels 0..2 --quiet --intrinsics 131,131,80,60 --out o",
        "run 'synthetic:room?frames=2' --quiet --out o", "run a.oni --model combined --quiet --out o"}) {
    for (int limit_mb = 120; limit_mb <= 1200; limit_mb += limit_mb < 460 ? 10 : 200) {
      const ProgramResult outcome = shell(fmt::format("ulimit -v {}; $P {}", limit_mb * 1024, command));
      if (outcome.status == 127) continue;  // the system's loader had too little
      SCOPED_TRACE(fmt::format("{} MB: {}", limit_mb, command));
      EXPECT_THAT(outcome.status, AnyOf(kDone, kFailed)) << outcome.err;
      if (outcome.status == kFailed) {
        EXPECT_TRUE(outcome.one_error_line());
        EXPECT_THAT(outcome.err, Not(HasSubstr("unexpected")));
      }
      ++(outcome.status == kDone ? done : failed);
    }
  }
  EXPECT_GT(failed, 5);
  EXPECT_GT(done, 5);
}
#endif

}  // namespace
}  // namespace saccade
