// `saccade eval` as a user starts it.

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/file.hpp"
#include "core/png.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;

const std::string kScenes = "synthetic:table?seed=3&noise=kinect&size=160x120&frames=7&scenes=7";

class EvalTest : public ProgramTest {
 protected:
  static std::vector<std::string> command(const std::string& source, const std::string& out,
                                          const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"eval", source, "--out", out};
    const std::vector<std::pair<std::string, std::string>> usual = {
        {"--levels", "0..2"}, {"--kernels", "9,15"}, {"--selectors", "proto,wta"}, {"--points", "6"}};
    for (const auto& [option, value] : usual)
      if (std::find(more.begin(), more.end(), option) == more.end())
        arguments.insert(arguments.end(), {option, value});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  ProgramResult eval(const std::string& out, const std::vector<std::string>& more = {},
                     const std::string& source = kScenes) const {
    return run_saccade(command(source, in(out), more));
  }

  void expect_error(int status, const std::string& part, const std::vector<std::string>& arguments) const {
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_TRUE(outcome.one_error_line());
    EXPECT_THAT(outcome.err, HasSubstr(part));
  }

  // The report without what depends on how busy the machine was.
  Json report(const std::string& out) const {
    Json all = Json::parse(text(out + "/report.json"));
    for (Json& condition : all["conditions"]) condition.erase("times_ms");
    return all;
  }

  void expect_same(const std::string& a, const std::string& b) const {
    for (const char* name : {"hr.csv", "hr.svg", "hr.png", "index.html"})
      EXPECT_TRUE(text(a + "/" + name) == text(b + "/" + name)) << name;
    EXPECT_EQ(report(a), report(b));
    int pictures = 0;
    for (const auto& file : fs::directory_iterator(folder_ / a / "examples")) {
      const std::string name = "/examples/" + file.path().filename().string();
      EXPECT_TRUE(text(a + name) == text(b + name)) << name;
      ++pictures;
    }
    EXPECT_GT(pictures, 0);
  }

  std::vector<std::string> lines(const std::string& name) const {
    std::istringstream stream(text(name));
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }

  void put(const std::string& name, const cv::Mat& image) const {
    fs::create_directories(folder_ / "data");
    write_file(folder_ / "data" / name, encode_png(image));
  }
};

TEST_F(EvalTest, WritesAllFiles) {
  const ProgramResult outcome = eval("out");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("symmetry3d, k = 15, wta"));
  EXPECT_THAT(outcome.out, HasSubstr("7 images"));
  EXPECT_EQ(lines("out/hr.csv").size(), 1 + 7 * 4 * 6U);
  const Json all = report("out");
  EXPECT_EQ(all["images"], 7);
  EXPECT_EQ(all["conditions"].size(), 4U);
  EXPECT_GT(all["conditions"][2]["hr"][0]["mean"], all["baselines"]["random"][0]["mean"]);
  EXPECT_LE(all["conditions"][2]["hr"][5]["mean"], all["bound"][5]["mean"]);
  const cv::Mat figure = cv::imread(in("out/hr.png"));
  EXPECT_GT(figure.cols, 1000);
  EXPECT_THAT(text("out/hr.svg"), HasSubstr("</svg>"));
  const std::string page = text("out/index.html");
  for (const auto& file : fs::directory_iterator(folder_ / "out/examples"))
    EXPECT_THAT(page, HasSubstr("examples/" + file.path().filename().string()));
}

TEST_F(EvalTest, WorkersDoNotChangeResults) {
  EXPECT_EQ(eval("one", {"--workers", "1"}).status, 0);
  EXPECT_EQ(eval("three", {"--workers", "3"}).status, 0);
  expect_same("one", "three");
}

TEST_F(EvalTest, GoesOnAfterACut) {
  ASSERT_EQ(eval("whole").status, 0);
  const auto all = lines("whole/results.jsonl");
  ASSERT_EQ(all.size(), 9U) << "plan, 7 images, end";
  fs::create_directories(folder_ / "cut");
  write_file(folder_ / "cut/results.jsonl",
             all[0] + "\n" + all[1] + "\n" + all[2] + "\n" + all[3].substr(0, all[3].size() / 2));
  const ProgramResult outcome = eval("cut");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("2 images evaluated already"));
  EXPECT_EQ(lines("cut/results.jsonl")[2], all[2]) << "not evaluated again";
  expect_same("whole", "cut");
}

TEST_F(EvalTest, GoesOnAfterAnInterruption) {
  const std::string many = "synthetic:table?seed=3&size=160x120&frames=120&camera=orbit&rate=3";
  const ProgramResult stopped =
      run_saccade(command(many, in("stopped")), 0, folder_ / "stopped/results.jsonl");
  EXPECT_EQ(stopped.status, kUnfinished);
  EXPECT_THAT(stopped.err, HasSubstr("interrupted"));
  EXPECT_FALSE(fs::exists(folder_ / "stopped/report.json"));
  EXPECT_EQ(eval("stopped", {}, many).status, 0);
  EXPECT_EQ(eval("whole", {}, many).status, 0);
  expect_same("whole", "stopped");
}

TEST_F(EvalTest, MergedShardsAreTheWhole) {
  ASSERT_EQ(eval("whole").status, 0);
  for (const char* i : {"1", "2", "3"})
    ASSERT_EQ(eval(std::string("part") + i, {"--shard", std::string(i) + "/3"}).status, 0);
  EXPECT_EQ(report("part1")["images"], 3);
  EXPECT_EQ(report("part3")["shard"], "3/3");
  const ProgramResult outcome = run_saccade(
      {"eval", "--merge", in("part3"), in("part1"), in("part2"), "--out", in("merged"), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  expect_same("whole", "merged");
  expect_error(kUsage, "of 3 shards, shard 2 is missing",
               {"eval", "--merge", in("part3"), in("part1"), "--out", in("merged")});
}

TEST_F(EvalTest, PartialResultsSayWhatTheyLack) {
  for (const char* i : {"1", "4"})
    ASSERT_EQ(eval(std::string("part") + i, {"--shard", std::string(i) + "/4"}).status, 0);
  const auto all = lines("part4/results.jsonl");
  write_file(folder_ / "part4/results.jsonl", all[0] + "\n" + all[1] + "\n");  // without its end
  expect_error(kUsage, "of 4 shards, shards 2, 3 are missing and shard 4 is not complete",
               {"eval", "--merge", in("part4"), in("part1"), "--out", in("merged")});
  const ProgramResult outcome =
      run_saccade({"eval", "--merge", in("part4"), in("part1"), "--partial", "--out", in("merged")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string lack = "of 4 shards, shards 2, 3 are missing and shard 4 is not complete; 3 of 7 images";
  EXPECT_THAT(outcome.out, ::testing::StartsWith("PARTIAL: " + lack));
  EXPECT_EQ(report("merged")["partial"], lack);
  EXPECT_EQ(report("merged")["images"], 3);
  EXPECT_THAT(text("merged/index.html"), HasSubstr(lack));
  EXPECT_EQ(eval("merged").status, 0) << "goes on with the rest";
  EXPECT_EQ(report("merged")["images"], 7);
  EXPECT_FALSE(report("merged").contains("partial"));
}

TEST_F(EvalTest, StatusReportsEveryShard) {
  ASSERT_EQ(eval("part1", {"--shard", "1/3"}).status, 0);
  ASSERT_EQ(eval("part3", {"--shard", "3/3"}).status, 0);
  const auto all = lines("part3/results.jsonl");
  write_file(folder_ / "part3/results.jsonl", all[0] + "\n" + all[1] + "\n");
  fs::create_directory(folder_ / "empty");
  ProgramResult outcome = run_saccade({"eval", "--status", in("part1"), in("part3"), in("empty")});
  EXPECT_EQ(outcome.status, kUnfinished);
  EXPECT_THAT(outcome.out, HasSubstr("shard 1/3   3 of 3 images   complete\n"));
  EXPECT_THAT(outcome.out, HasSubstr("shard 3/3   1 of 2 images   stopped\n"));
  EXPECT_THAT(outcome.err, HasSubstr("1 of 3 shards complete; missing: 2"));
  outcome = run_saccade({"eval", "--status", in("part1"), in("part3"), "--json"});
  const Json status = Json::parse(outcome.out);
  EXPECT_EQ(status["complete"], false);
  EXPECT_EQ(status["missing"], "2");
  EXPECT_EQ(status["shards"][1]["done"], 1);
  ASSERT_EQ(eval("whole").status, 0);
  EXPECT_EQ(run_saccade({"eval", "--status", in("whole")}).status, 0);
}

TEST_F(EvalTest, TheContentOfADataSetCountsNotItsPath) {
  cv::Mat1w depth(120, 160, std::uint16_t{1000});
  depth(cv::Rect(60, 40, 30, 30)).setTo(900);
  cv::Mat1b labels(120, 160, std::uint8_t{0});
  labels(cv::Rect(60, 40, 30, 30)).setTo(1);
  for (const char* name : {"0000", "0001"}) {
    put(std::string(name) + "_depth.png", depth);
    put(std::string(name) + "_label.png", labels);
  }
  fs::copy(folder_ / "data", folder_ / "copy");
  const auto shard = [&](const std::string& out, const std::string& i, const std::string& source) {
    return eval(out, {"--log-level", "error", "--shard", i + "/2"}, source).status;
  };
  ASSERT_EQ(shard("part1", "1", in("data")), 0);
  ASSERT_EQ(shard("part2", "2", in("copy")), 0);
  EXPECT_EQ(
      run_saccade({"eval", "--merge", in("part1"), in("part2"), "--out", in("merged"), "--quiet"}).status, 0);
  depth(0, 0) = 0;
  write_file(folder_ / "copy/0001_depth.png", encode_png(depth));
  ASSERT_EQ(shard("other2", "2", in("copy")), 0);
  expect_error(kUsage, "the images of the data sets",
               {"eval", "--merge", in("part1"), in("other2"), "--out", in("merged")});
}

// As on a cluster: the batch script of this room, run by GNU parallel in place of Slurm.
TEST_F(EvalTest, TheBatchScriptRunsUnderGnuParallel) {
  if (run_program("sh", {"-c", "command -v parallel"}).status != 0)
    GTEST_SKIP() << "parallel is not installed";
  const fs::path program = folder_ / "bin/saccade";
  fs::create_directory(folder_ / "bin");
  fs::create_symlink(saccade_program(), program);
  const std::string script = in_source("src/eval/cluster.sh");
  const std::string line = "PATH=" + in("bin") +
                           ":$PATH SHARDS=3 parallel --will-cite -q -j 2 env SLURM_ARRAY_TASK_ID={} bash " +
                           script + " eval '" + kScenes + "' " + in("out") +
                           " --levels 0..2 --kernels 9,15 --selectors proto,wta --points 6 --quiet ::: 1 2 3";
  const ProgramResult outcome = run_program("sh", {"-c", line});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(run_saccade({"eval", "--status", in("out/1"), in("out/2"), in("out/3")}).status, 0);
  ASSERT_EQ(run_saccade(
                {"eval", "--merge", in("out/1"), in("out/2"), in("out/3"), "--out", in("merged"), "--quiet"})
                .status,
            0);
  ASSERT_EQ(eval("whole").status, 0);
  expect_same("whole", "merged");
}

TEST_F(EvalTest, FramesWhoseLabelsDoNotFitAreNamedAndLeftOut) {
  cv::Mat1w depth(120, 160, std::uint16_t{1000});
  depth(cv::Rect(60, 40, 30, 30)).setTo(900);
  cv::Mat1b labels(120, 160, std::uint8_t{0});
  labels(cv::Rect(60, 40, 30, 30)).setTo(1);
  for (const char* name : {"0000", "0001", "0002"}) put(std::string(name) + "_depth.png", depth);
  put("0000_label.png", labels);
  put("0001_label.png", labels(cv::Rect(0, 0, 80, 60)));
  const ProgramResult outcome = eval("out", {}, in("data"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("2 images left out (see report.json), the first, frame 1: 0001: no labels: "
                        "0001_label.png: 80x60"));
  const Json all = report("out");
  EXPECT_EQ(all["images"], 1);
  ASSERT_EQ(all["left_out"].size(), 2U);
  EXPECT_EQ(all["left_out"][0]["name"], "0001");
  EXPECT_EQ(all["left_out"][1]["reason"], "it has no label image");
}

TEST_F(EvalTest, WithoutAnyLabelTheReasonIsTheOnlyLine) {
  for (const char* name : {"0000", "0001"})
    put(std::string(name) + "_depth.png", cv::Mat1w(120, 160, std::uint16_t{1000}));
  const ProgramResult outcome = eval("out", {}, in("data"));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(outcome.one_error_line());
  EXPECT_THAT(outcome.err,
              HasSubstr("none of 2 images could be evaluated; the first: it has no label image"));
}

TEST_F(EvalTest, SelectsFramesAndPrintsJson) {
  const ProgramResult outcome = eval("out", {"--start", "1", "--every", "2", "--frames", "2", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json summary = Json::parse(outcome.out);
  EXPECT_EQ(summary["images"], 2);
  EXPECT_EQ(summary["out"], in("out"));
  EXPECT_THAT(lines("out/hr.csv")[1], ::testing::StartsWith("1,"));
  EXPECT_THAT(lines("out/hr.csv").back(), ::testing::StartsWith("3,"));
}

TEST_F(EvalTest, OverTimeWritesTableAndFigure) {
  const std::string scene = "synthetic:table?seed=3&noise=kinect&size=160x120&frames=40&camera=orbit";
  const auto run = [&](const std::string& out, const std::string& workers) {
    return run_saccade({"eval", scene, "--out", in(out), "--over-time", "--levels", "0..2", "--models",
                        "symmetry3d,centre", "--workers", workers});
  };
  const ProgramResult outcome = run("one", "1");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"held-30, n = 5", "first stays", "IDF1", "best IDF1, over time", "ids per place",
                           "under the right id", "cuts"})
    EXPECT_THAT(outcome.out, HasSubstr(name));
  const Json report = Json::parse(text("one/over_time.json"));
  ASSERT_EQ(report["models"].size(), 2U);
  const Json& model = report["models"][0];
  EXPECT_EQ(model["model"], "symmetry3d");
  EXPECT_EQ(model["frames"], 40);
  EXPECT_EQ(model["cuts"], 0);
  EXPECT_GT(model["held_1"]["5"].get<double>(), 0.8);
  EXPECT_EQ(model["hit_ratio"]["over_time"].size(), 10U);
  EXPECT_GE(model["best_identity_f1"]["over_time"].get<double>(), model["identity_f1"].get<double>());
  EXPECT_GT(model["best_identity_f1"]["frame_by_frame"].get<double>(), 0.5);
  const Json& identity = model["identity"];
  EXPECT_EQ(identity["in_view"], identity["right_id"].get<int>() + identity["other_id"].get<int>() +
                                     identity["in_other"].get<int>() + identity["without_point"].get<int>());
  EXPECT_GT(identity["right_id"], 0);
  EXPECT_FALSE(identity["objects"].empty());
  EXPECT_FALSE(cv::imread(in("one/over_time.png")).empty());
  EXPECT_THAT(text("one/over_time.svg"), HasSubstr("held-30"));
  ASSERT_EQ(run("two", "2").status, 0);
  EXPECT_EQ(text("one/over_time.json"), text("two/over_time.json"));
}

TEST_F(EvalTest, OverTimeNeedsLabelsOrPoses) {
  const fs::path still = folder_ / "still";
  fs::create_directory(still);
  write_file(still / "0000_depth.png", encode_png(cv::Mat1w(120, 160, static_cast<ushort>(900))));
  expect_error(kUnreadable, "neither labels nor a camera pose",
               {"eval", still.string(), "--out", in("out"), "--over-time", "--intrinsics", "100,100,80,60"});
}

TEST_F(EvalTest, Errors) {
  const std::string out = in("out");
  expect_error(kUsage, "no data set", {"eval", "--out", out});
  expect_error(kUsage, "no folder to write to", {"eval", kScenes});
  expect_error(kUsage, "3..127", command(kScenes, out, {"--kernels", "200"}));
  expect_error(kUsage, "symmetry3d", command(kScenes, out, {"--models", "nonsense"}));
  expect_error(kUsage, "i/n", command(kScenes, out, {"--shard", "4/3"}));
  expect_error(kUsage, "shard 8 holds no frame", command(kScenes, out, {"--shard", "8/9"}));
  expect_error(kUsage, "--start 7", command(kScenes, out, {"--start", "7"}));
  expect_error(kUsage, "points", command(kScenes, out, {"--points", "0"}));
  expect_error(kUsage, "--merge", command(kScenes, out, {"--merge", out}));
  for (const std::string option : {"--kernels", "--selectors", "--shard"})
    expect_error(kUsage, option, {"eval", kScenes, "--out", out, "--over-time", option, "1/1"});
  for (const std::string option : {"--models", "--kernels", "--selectors", "--shard", "--points"})
    expect_error(kUsage, option, {"eval", "--merge", out, option, "3", "--out", out});
  expect_error(kUsage, "level 5", command(kScenes, out, {"--levels", "0..5"}));
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is made before the command line is right";
  expect_error(kUnreadable, "no such source", command(in("nowhere"), out));
  expect_error(kUnreadable, "results.jsonl", {"eval", "--merge", in("nowhere"), "--out", out});
  write_file(folder_ / "file", std::string_view("x"));
  expect_error(kFailed, "file", command(kScenes, in("file")));
  EXPECT_EQ(eval("out").status, 0);
  expect_error(kUsage, "points is 6, not 7", command(kScenes, out, {"--points", "7"}));
}

TEST_F(EvalTest, NoLabelsAtAll) {
  put("0000_depth.png", cv::Mat1w(120, 160, std::uint16_t{1000}));
  const ProgramResult outcome = eval("out", {"--log-level", "error"}, in("data"));
  EXPECT_EQ(outcome.status, kUnreadable);
  EXPECT_THAT(outcome.err, HasSubstr("none of 1 image could be evaluated; the first: it has no label"));
  EXPECT_TRUE(outcome.one_error_line());
}

TEST_F(EvalTest, AFullDiskIsAFailure) {
  fs::create_directories(folder_ / "out");
  fs::create_symlink("/dev/full", folder_ / "out/hr.csv");
  expect_error(kFailed, "No space left", command(kScenes, in("out"), {"--frames", "1", "--quiet"}));
}

}  // namespace
}  // namespace saccade
