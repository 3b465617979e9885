// `saccade` with input that it cannot use: one line of error, and the exit status.

#include <span>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/png.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RunErrorsTest : public ProgramTest {
 protected:
  // Runs on the scene with more arguments and expects one line of error that contains `text`.
  void expect(int status, const std::string& part, const std::vector<std::string>& more,
              const std::string& source = kSmallScene, const std::string& out = "out") const {
    std::vector<std::string> arguments = {"run", source, "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, status) << part << ": " << outcome.err;
    EXPECT_TRUE(outcome.one_error_line());
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(outcome.out, "");
  }

  void put(const std::string& name, const cv::Mat& image) const {
    fs::create_directories(folder_ / "data");
    write_file(folder_ / "data" / name, encode_png(image));
  }
};

TEST_F(RunErrorsTest, OptionsOutOfRange) {
  expect(kUsage, "3..127", {"--kernel", "2"});
  expect(kUsage, "3..127", {"--kernel", "128"});
  expect(kUsage, "symmetry3d", {"--model", "nonsense"});
  expect(kUsage, "level 5 has only 5x4 pixels", {"--levels", "0..5"},
         "synthetic:table?frames=1&size=160x128");
  expect(kUsage, "try --levels 0..4", {"--levels", "0..9"});
  expect(kUsage, "fx,fy,cx,cy", {"--intrinsics", "nan,525,320,240"});
  expect(kUsage, "fx,fy,cx,cy", {"--intrinsics=-525,525,320,240"});
  expect(kUsage, "maps, levels", {"--dump", "everything"});
  expect(kUsage, "it has 2 frames", {"--start", "2", "--levels", "0..2"});
  expect(kUnreadable, "the image is too small", {}, "synthetic:table?frames=1&size=20x7");
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is made before the command line is right";
}

TEST_F(RunErrorsTest, ModelsThatDoNotFit) {
  expect(kUsage, "model itti has no levels to dump", {"--model", "itti", "--dump", "maps,levels"});
  expect(kUsage, "model centre has no normals to dump", {"--model", "centre", "--dump", "normals"});
  expect(kUsage, "try --levels 0..4", {"--model", "combined", "--levels", "0..5"});

  EXPECT_FALSE(fs::exists(folder_ / "out"));
  put("0000_depth.png", cv::Mat1w(128, 160, std::uint16_t{1000}));
  expect(kUnreadable, "model itti needs colour", {"--model", "itti", "--intrinsics", "131,131,80,64"},
         in("data"));
}

TEST_F(RunErrorsTest, CommandLine) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"nonsense"},
                                                    {"run"},
                                                    {"run", kSmallScene},
                                                    {"run", kSmallScene, "--out", in("o"), "--kernal", "9"},
                                                    {"run", kSmallScene, "--out", in("o"), "--kernel"}}) {
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, kUsage) << outcome.err;
    EXPECT_TRUE(outcome.one_error_line());
  }
  EXPECT_EQ(run_saccade({"--help"}).status, 0);
  EXPECT_THAT(run_saccade({"run", "--help"}).out, HasSubstr("--kernel"));
  EXPECT_THAT(run_saccade({"--version"}).out, HasSubstr("saccade "));
}

TEST_F(RunErrorsTest, Configuration) {
  write_file(folder_ / "c.toml", std::string_view("kernle = 9\n"));
  expect(kUsage, "did you mean kernel?", {"--config", in("c.toml")});
  write_file(folder_ / "c.toml", std::string_view("kernel = \n"));
  expect(kUsage, "not valid TOML", {"--config", in("c.toml")});
  expect(kUnreadable, "none.toml", {"--config", in("none.toml")});
  expect(kUnreadable, "/dev/zero", {"--config", "/dev/zero"});
}

TEST_F(RunErrorsTest, Sources) {
  expect(kUnreadable, "no such source", {}, in("nowhere"));
  expect(kUsage, "nonsense", {}, "synthetic:nonsense");
  expect(kUsage, "sede", {}, "synthetic:table?sede=3");
  fs::create_directories(folder_ / "data");
  expect(kUnreadable, "no frames in the folder", {}, in("data"));
  put("0000_depth.png", cv::Mat1b(64, 64, std::uint8_t{1}));
  expect(kUnreadable, "8-bit grey", {}, in("data"));
  put("0000_depth.png", cv::Mat3b(64, 64, cv::Vec3b()));
  expect(kUnreadable, "8-bit RGB", {}, in("data"));
  put("0000_depth.png", cv::Mat1w(64, 64, std::uint16_t{800}));
  write_file(folder_ / "data/meta.json", std::string_view("{"));
  expect(kUnreadable, "meta.json", {}, in("data"));
}

TEST_F(RunErrorsTest, NoFrameOfTheSourceIsUsable) {
  put("0000_depth.png", cv::Mat1w(160, 160, std::uint16_t{800}));
  const auto bytes = read_file(folder_ / "data/0000_depth.png");
  write_file(folder_ / "data/0000_depth.png", std::span(bytes).first(bytes.size() / 2));
  const ProgramResult outcome =
      run_saccade({"run", in("data"), "--out", in("out"), "--intrinsics", "500,500,80,80"});
  EXPECT_EQ(outcome.status, kUnreadable);
  EXPECT_THAT(outcome.err, HasSubstr("0000_depth.png: not a valid PNG"));
  EXPECT_EQ(nlohmann::json::parse(text("out/manifest.json"))["status"], "failed");
}

TEST_F(RunErrorsTest, OutputThatCannotBeWritten) {
  const std::vector<std::string> levels = {"--levels", "0..2"};
  write_file(folder_ / "file", std::string_view("x"));
  expect(kFailed, "file", levels, kSmallScene, "file");
  expect(kFailed, "file/deeper", levels, kSmallScene, "file/deeper");
  const ProgramResult device = run_saccade({"run", kSmallScene, "--out", "/dev/full", "--levels", "0..2"});
  EXPECT_EQ(device.status, kFailed);
  EXPECT_TRUE(device.one_error_line());

  fs::create_directories(folder_ / "full");
  for (const char* name :
       {"fixations.jsonl", "000001_saliency.tiff", "000001_overlay.png", "manifest.json"}) {
    fs::remove_all(folder_ / "full");
    fs::create_directories(folder_ / "full");
    fs::create_symlink("/dev/full", folder_ / "full" / name);
    expect(kFailed, "No space left on device", levels, kSmallScene, "full");
    EXPECT_TRUE(fs::is_symlink(folder_ / "full" / name));
  }
}

}  // namespace
}  // namespace saccade
