// `saccade run`: the files that it writes.

#include <cmath>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/file.hpp"
#include "core/png.hpp"
#include "saliency/symmetry3d.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Small and fast; two levels fit.
const std::string kScene = "synthetic:table?seed=3&noise=kinect&size=160x120&frames=6&camera=orbit";

class RunTest : public ProgramTest {
 protected:
  ProgramResult run(const std::string& out, std::vector<std::string> more = {},
                    const std::string& source = kScene) const {
    std::vector<std::string> arguments = {"run", source, "--out", in(out), "--levels", "0..2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome;
  }

  std::vector<json> lines(const std::string& name) const {
    std::istringstream stream(text(name));
    std::vector<json> all;
    for (std::string line; std::getline(stream, line);) all.push_back(json::parse(line));
    return all;
  }

  std::set<std::string> files(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(folder_ / folder))
      names.insert(file.path().filename().string());
    return names;
  }
};

TEST_F(RunTest, WritesMapsOverlaysFixationsAndManifest) {
  const ProgramResult outcome = run("out");
  EXPECT_THAT(outcome.out, ::testing::HasSubstr("6 frames"));
  for (int i = 0; i < 6; ++i)
    for (const char* ending : {"saliency.tiff", "saliency.png", "overlay.png"})
      EXPECT_TRUE(fs::exists(folder_ / "out" / (std::string("00000") + std::to_string(i) + "_" + ending)));
  EXPECT_EQ(files("out").size(), 6 * 3 + 2U);

  const cv::Mat map = cv::imread(in("out/000000_saliency.tiff"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(map.type(), CV_32FC1);
  EXPECT_EQ(map.size(), cv::Size(160, 120));
  EXPECT_EQ(cv::imread(in("out/000000_saliency.png"), cv::IMREAD_UNCHANGED).type(), CV_8UC1);
  EXPECT_EQ(cv::imread(in("out/000000_overlay.png"), cv::IMREAD_UNCHANGED).type(), CV_8UC3);

  const auto frames = lines("out/fixations.jsonl");
  ASSERT_EQ(frames.size(), 6U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i]["frame"], i);
    EXPECT_EQ(frames[i]["timestamp_us"], std::llround(static_cast<double>(i) * 1e6 / 30));
    ASSERT_FALSE(frames[i]["fixations"].empty());
    int rank = 0;
    for (const json& f : frames[i]["fixations"]) {
      EXPECT_EQ(f["rank"], ++rank);
      for (const char* key : {"row", "col", "saliency", "x_mm", "y_mm", "z_mm"})
        EXPECT_TRUE(f[key].is_number()) << key;
    }
  }
  const json& first = frames[0]["fixations"][0];
  EXPECT_EQ(first["saliency"].get<float>(), map.at<float>(first["row"].get<int>(), first["col"].get<int>()));

  const json manifest = json::parse(text("out/manifest.json"));
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["ledger"], json({{"captured", 6}, {"processed", 6}, {"dropped", 0}, {"rejected", 0}}));
  EXPECT_EQ(manifest["settings"]["kernel"], 15);
  EXPECT_EQ(manifest["settings"]["levels"], "0..2");
  EXPECT_EQ(manifest["intrinsics"]["fx"], 525.0 / 4);
  EXPECT_EQ(manifest["source"]["uri"], kScene);
  EXPECT_GT(manifest["stages_ms"]["symmetry"]["p50"], 0);
  EXPECT_EQ(manifest["command_line"][1], "run");
}

TEST_F(RunTest, SameBytesForAnyNumberOfWorkersTwice) {
  const std::vector<std::string> dump = {"--dump", "maps,levels,overlay,normals,masks"};
  const auto with = [&](const char* workers) {
    auto more = dump;
    more.insert(more.end(), {"--workers", workers});
    return more;
  };
  run("one", with("1"));
  run("two", with("2"));
  run("five", with("5"));
  run("again", with("2"));
  const auto names = files("one");
  EXPECT_EQ(names.size(), 6 * (3 + 3 + 1 + 1) + 2U);
  for (const std::string& name : names) {
    if (name == "manifest.json") continue;
    for (const char* other : {"two/", "five/", "again/"})
      EXPECT_TRUE(text("one/" + name) == text(other + name)) << name;
  }
}

TEST_F(RunTest, DumpsTheRequestedFiles) {
  run("out", {"--dump", "levels,normals,masks", "--frames", "1"});
  EXPECT_EQ(files("out"), (std::set<std::string>{"000000_level0.tiff", "000000_level1.tiff",
                                                 "000000_level2.tiff", "000000_normals.tiff",
                                                 "000000_masks.png", "fixations.jsonl", "manifest.json"}));
  EXPECT_EQ(cv::imread(in("out/000000_level2.tiff"), cv::IMREAD_UNCHANGED).size(), cv::Size(40, 30));
  const cv::Mat masks = cv::imread(in("out/000000_masks.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(masks.type(), CV_16UC1);
  // imread reverses the file's x, y, z; a normal of the table's top faces up, against the image's y axis.
  const cv::Mat normals = cv::imread(in("out/000000_normals.tiff"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(normals.type(), CV_32FC3);
  const auto z_y_x = normals.at<cv::Vec3f>(118, 80);
  EXPECT_NEAR(cv::norm(z_y_x), 1, 1e-4);
  EXPECT_LT(z_y_x[0], 0) << "towards the camera";
  EXPECT_LT(z_y_x[1], -0.4F) << "upwards";
  run("labels", {"--dump", "labels", "--frames", "1"});
  const cv::Mat labels = cv::imread(in("labels/000000_labels.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(labels.type(), CV_16UC1);
  EXPECT_GT(cv::countNonZero(labels), 100);
  run("none", {"--dump", "none"});
  EXPECT_EQ(files("none"), (std::set<std::string>{"fixations.jsonl", "manifest.json"}));
}

TEST_F(RunTest, StartEveryAndFramesKeepTheSourcesIndices) {
  run("out", {"--start", "1", "--every", "2", "--frames", "2", "--dump", "maps"});
  const auto frames = lines("out/fixations.jsonl");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0]["frame"], 1);
  EXPECT_EQ(frames[1]["frame"], 3);
  EXPECT_TRUE(fs::exists(folder_ / "out/000003_saliency.tiff"));
}

TEST_F(RunTest, StandardOutputHasOnlyTheJson) {
  const ProgramResult outcome = run("out", {"--json", "--frames", "2"});
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["ledger"]["processed"], 2);
  EXPECT_EQ(summary["status"], "done");
  EXPECT_EQ(run("out", {"--quiet", "--frames", "1"}).out, "");
}

TEST_F(RunTest, TheCommandLineOverridesTheConfigFile) {
  write_file(folder_ / "c.toml", std::string_view("kernel = 9\nfixations = 3\ndump = \"none\"\n"));
  run("out", {"--config", in("c.toml"), "--fixations", "2", "--frames", "1"});
  const json manifest = json::parse(text("out/manifest.json"));
  EXPECT_EQ(manifest["settings"]["kernel"], 9);
  EXPECT_EQ(lines("out/fixations.jsonl")[0]["fixations"].size(), 2U);
}

TEST_F(RunTest, PaperConfigRunsTheNetwork) {
  const ProgramResult outcome = run_saccade({"run", "synthetic:table?frames=1", "--out", in("out"),
                                             "--config", in_source("config/paper.toml"), "--dump", "none"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json frame = lines("out/fixations.jsonl")[0];
  ASSERT_FALSE(frame["fixations"].empty());
  for (const json& f : frame["fixations"]) EXPECT_EQ(f["row"].get<int>() % 16, 8);
}

TEST_F(RunTest, UnusableFramesAreRejectedAndTheRestIsProcessed) {
  for (int i = 0; i < 4; ++i)
    write_file(folder_ / ("000" + std::to_string(i) + "_depth.png"),
               encode_png(cv::Mat1w(64, 64, std::uint16_t{900})));
  write_file(folder_ / "0002_depth.png", std::string_view("not a picture"));
  const ProgramResult outcome = run("out", {}, folder_.string());
  EXPECT_THAT(outcome.err, ::testing::HasSubstr(
                               "1 frame rejected (see manifest.json), the first, frame 2: 0002_depth.png"));
  const json manifest = json::parse(text("out/manifest.json"));
  EXPECT_EQ(manifest["ledger"], json({{"captured", 4}, {"processed", 3}, {"dropped", 0}, {"rejected", 1}}));
  EXPECT_EQ(manifest["rejected"][0]["frame"], 2);
  EXPECT_TRUE(fs::exists(folder_ / "out/000003_saliency.tiff"));
}

TEST_F(RunTest, DefaultLevelsAreCutToThoseTheImageHasRoomFor) {
  const ProgramResult outcome =
      run_saccade({"run", "synthetic:table?frames=1&size=40x30", "--out", in("out")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("40x30 images have room for levels 0..2 only"));
  EXPECT_EQ(json::parse(text("out/manifest.json"))["settings"]["levels"], "0..2");
}

TEST_F(RunTest, DepthWithoutAnyReadingGivesAZeroMapAndNoFixations) {
  write_file(folder_ / "0000_depth.png", encode_png(cv::Mat1w(64, 64, std::uint16_t{0})));
  for (const char* selector : {"proto", "wta"}) {
    run("out", {"--selector", selector}, folder_.string());
    EXPECT_EQ(cv::countNonZero(cv::imread(in("out/000000_saliency.tiff"), cv::IMREAD_UNCHANGED)), 0);
    const json frame = lines("out/fixations.jsonl")[0];
    EXPECT_TRUE(frame["fixations"].empty());
    EXPECT_FALSE(frame["ended_early"].get<std::string>().empty());
  }
}

// The whole chain as ./run shows it: recording, operator, attention; the first points are on different
// objects.
TEST_F(RunTest, TheObjectsOfTheBundledRecordingAreFoundOneByOne) {
  const std::string recordings = in_source("recordings/");
  const ProgramResult outcome =
      run_saccade({"run", recordings + "table.oni", "--out", in("out"), "--dump", "none"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto frames = lines("out/fixations.jsonl");
  ASSERT_EQ(frames.size(), 16U);
  double hits = 0, possible = 0;
  for (const json& frame : frames) {
    const auto name = std::to_string(frame["frame"].get<int>() + 10000).substr(1) + "_label.png";
    const cv::Mat labels = decode_png(read_file(recordings + "table_labels/" + name));
    std::set<int> present, found;
    for (int r = 0; r < labels.rows; ++r)
      for (int c = 0; c < labels.cols; ++c) present.insert(labels.at<std::uint16_t>(r, c));
    present.erase(0);
    for (std::size_t i = 0; i < present.size(); ++i)
      found.insert(labels.at<std::uint16_t>(frame["fixations"][i]["row"].get<int>(),
                                            frame["fixations"][i]["col"].get<int>()));
    found.erase(0);
    hits += static_cast<double>(found.size());
    possible += static_cast<double>(present.size());
  }
  EXPECT_GE(hits / possible, 0.9);
}

TEST_F(RunTest, BenchReportsTheModesThatThisMachineSustains) {
  const ProgramResult outcome =
      run_saccade({"bench", "--json", "--seconds", "0", "--kernel", "5", "--levels", "0..1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  ASSERT_EQ(report["sizes"].size(), 4U);
  for (const json& size : report["sizes"]) {
    EXPECT_NEAR(size["valid"].get<double>(), 0.8, 0.005);
    EXPECT_GE(size["frame_p95_ms"], size["frame_p50_ms"]);
    EXPECT_TRUE(size["sustains"]["30 Hz"].is_boolean());
  }
  EXPECT_GT(report["sizes"][1]["reference_ratio"], 1);
}

TEST_F(RunTest, InterruptingLeavesCompleteFilesAndIsReported) {
  const ProgramResult outcome =
      run_saccade({"run", "synthetic:table?noise=kinect&frames=100000", "--out", in("out")}, 150,
                  folder_ / "out/000000_overlay.png");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json manifest = json::parse(text("out/manifest.json"));
  EXPECT_EQ(manifest["status"], "interrupted");
  const json& ledger = manifest["ledger"];
  const auto processed = ledger["processed"].get<std::int64_t>();
  EXPECT_EQ(ledger["captured"], processed + ledger["dropped"].get<std::int64_t>());
  EXPECT_EQ(lines("out/fixations.jsonl").size(), static_cast<std::size_t>(processed));
  EXPECT_EQ(files("out").size(), static_cast<std::size_t>(processed) * 3 + 2);
  for (const std::string& name : files("out")) {
    const bool picture = name.ends_with(".png") || name.ends_with(".tiff");
    EXPECT_TRUE(!picture || !cv::imread(in("out/" + name), cv::IMREAD_UNCHANGED).empty()) << name;
  }
}

}  // namespace
}  // namespace saccade
