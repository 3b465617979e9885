// `saccade export`, `run --dump depth` and `oni cut`: what was written is read back equal to the bit.
#include <sched.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "core/file.hpp"
#include "core/png.hpp"
#include "sources/open_source.hpp"
#include "tests/support/no_wait.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

const std::string kTable = in_source("recordings/table.oni");

std::vector<Frame> read_all(const std::string& uri, const SourceOptions& options = {}) {
  const auto source = open_source(uri, options);
  std::vector<Frame> frames;
  for (Frame frame; source->read(frame, kNoWait).status == ReadStatus::frame;) {
    frames.emplace_back();
    copy_frame(frame, frames.back());
  }
  return frames;
}

enum class Times { absolute, from_first };

void expect_same(const std::vector<Frame>& a, const std::vector<Frame>& b, Times times = Times::absolute,
                 bool colour = true) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::int64_t first = times == Times::absolute ? 0 : a[0].timestamp_us;
    EXPECT_EQ(a[i].timestamp_us - first, b[i].timestamp_us) << i;
    EXPECT_EQ(cv::norm(a[i].depth_mm, b[i].depth_mm, cv::NORM_INF), 0) << i;
    EXPECT_GT(cv::countNonZero(b[i].depth_mm), 0) << i;
    EXPECT_EQ(a[i].colour.empty(), b[i].colour.empty() && colour) << i;
    if (colour && !a[i].colour.empty()) {
      EXPECT_EQ(cv::norm(a[i].colour, b[i].colour, cv::NORM_INF), 0) << i;
    }
    EXPECT_DOUBLE_EQ(a[i].intrinsics.fx, b[i].intrinsics.fx);
    EXPECT_DOUBLE_EQ(a[i].intrinsics.cy, b[i].intrinsics.cy);
  }
}

class ExportTest : public ProgramTest {
 protected:
  ProgramResult run(std::vector<std::string> arguments) {
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome;
  }
  void export_as(const std::string& source, const std::string& format, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"export", source, "--out", in(format), "--format", format};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
  }
};

TEST_F(ExportTest, ARecordingAsAFolderIsTheSameSourceAgain) {
  export_as(kTable, "folder");
  const auto before = read_all(kTable), after = read_all(in("folder"));
  expect_same(before, after);
  const auto info = open_source(in("folder"))->info(), of_table = open_source(kTable)->info();
  EXPECT_EQ(info.sequence, of_table.sequence);
  EXPECT_EQ(info.rate_hz, of_table.rate_hz);
  EXPECT_EQ(info.depth_unit_mm, of_table.depth_unit_mm);
}

TEST_F(ExportTest, OtherFormatsKeepDepthAndTimesToo) {
  const std::vector<std::string> piece = {"--start", "2", "--every", "3", "--frames", "4"};
  export_as(kTable, "folder", piece);
  const auto before = read_all(in("folder"));
  ASSERT_EQ(before.size(), 4U);
  for (const std::string format : {"tum", "video", "ply", "pcd"}) {
    SCOPED_TRACE(format);
    export_as(kTable, format, piece);
    expect_same(before, read_all(format == "video" ? in("video/frames_depth.mkv") : in(format)),
                format == "tum" ? Times::from_first : Times::absolute, format != "ply");
  }
}

// A PLY has a point, and so a colour, for each reading.
TEST_F(ExportTest, PlyKeepsTheColourOfEachPoint) {
  export_as(kTable, "ply", {"--frames", "2"});
  const auto before = read_all(kTable), after = read_all(in("ply"));
  for (std::size_t i = 0; i < 2; ++i) {
    cv::Mat3b expected = before[i].colour.clone();
    expected.setTo(cv::Scalar::all(0), before[i].depth_mm == 0);
    EXPECT_EQ(cv::norm(expected, after[i].colour, cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(after[i].colour, cv::NORM_INF), 0);
  }
}

TEST_F(ExportTest, WithoutColourThereIsNoneInAnyFormat) {
  run({"record", "synthetic:cone?size=80x60&frames=2&noise=kinect", in("a.oni"), "--colour-codec", "off"});
  for (const std::string format : {"folder", "tum", "video", "ply", "pcd"}) {
    SCOPED_TRACE(format);
    export_as(in("a.oni"), format);
    expect_same(read_all(in("a.oni")),
                read_all(format == "video" ? in("video/frames_depth.mkv") : in(format)));
  }
}

// Lost cameras too: the second of these frames has no pose.
TEST_F(ExportTest, PosesComeBack) {
  fs::create_directory(folder_ / "walk");
  for (const char* name : {"walk/0_depth.png", "walk/1_depth.png", "walk/2_depth.png"})
    write_file(in(name), encode_png(cv::Mat1w(12, 16, std::uint16_t{1000})));
  const std::string none = "nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan\n";
  write_file(in("walk/poses.txt"), none + "0.6 0 0.8 1.5 0 1 0 -2 -0.8 0 0.6 0.25 0 0 0 1\n" + none);
  const auto before = read_all(in("walk"));
  for (const std::string format : {"folder", "tum"}) {
    SCOPED_TRACE(format);
    export_as(in("walk"), format);
    const auto after = read_all(in(format));
    ASSERT_EQ(after.size(), 3U);
    EXPECT_FALSE(after[0].truth.camera_to_world);
    ASSERT_TRUE(after[1].truth.camera_to_world);
    EXPECT_LT(cv::norm(before[1].truth.camera_to_world->matrix, after[1].truth.camera_to_world->matrix),
              2e-3);
    EXPECT_FALSE(after[2].truth.camera_to_world);
  }
}

TEST_F(ExportTest, TenthsOfAMillimetreStayExact) {
  run({"record", "synthetic:cone?size=80x60&frames=3", in("fine.oni"), "--stored-unit", "100um"});
  const auto before = read_all(in("fine.oni"));
  for (const std::string format : {"folder", "tum", "video", "ply", "pcd"}) {
    SCOPED_TRACE(format);
    export_as(in("fine.oni"), format);
    const auto after = read_all(format == "video" ? in("video/frames_depth.mkv") : in(format));
    ASSERT_EQ(after.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(cv::norm(before[i].depth_mm, after[i].depth_mm, cv::NORM_INF), 0);
  }
}

TEST_F(ExportTest, RealNumbersAreRoundedToAUnitThatIsReported) {
  const std::string scene = "synthetic:cone?size=80x60&frames=2";
  const ProgramResult outcome = run({"export", scene, "--out", in("a"), "--json"});
  const json report = json::parse(outcome.out);
  EXPECT_GT(report["rounded_pixels"], 0);
  EXPECT_LE(report["largest_rounding_mm"], 0.0501);
  EXPECT_THAT(outcome.err, HasSubstr("rounded to the stored unit"));
  EXPECT_EQ(json::parse(text("a/meta.json"))["depth_unit_mm"], 0.1);
  const auto before = read_all(scene), after = read_all(in("a"));
  EXPECT_LE(cv::norm(before[1].depth_mm, after[1].depth_mm, cv::NORM_INF), 0.0501);
  EXPECT_EQ(cv::norm(before[1].truth.labels, after[1].truth.labels, cv::NORM_INF), 0);
  ASSERT_TRUE(after[1].truth.camera_to_world.has_value());
}

TEST_F(ExportTest, DumpedDepthIsASourceAgain) {
  run({"run", kTable, "--out", in("out"), "--dump", "depth,colour", "--model", "centre", "--frames", "3"});
  auto before = read_all(kTable);
  before.resize(3);
  expect_same(before, read_all(in("out")));
}

TEST_F(ExportTest, ADumpedCloudHasNormalsAndTheDepthOfItsFrame) {
  run({"run", kTable, "--out", in("out"), "--dump", "cloud", "--frames", "1"});
  EXPECT_THAT(text("out/000000_cloud.ply"), HasSubstr("property float nx"));
  fs::create_directory(folder_ / "clouds");
  fs::copy(folder_ / "out/000000_cloud.ply", folder_ / "clouds/000000_cloud.ply");
  const auto before = read_all(kTable), after = read_all(in("clouds/000000_cloud.ply"));
  EXPECT_EQ(cv::norm(before[0].depth_mm, after[0].depth_mm, cv::NORM_INF), 0);
}

TEST_F(ExportTest, AnInterruptedExportIsAWholeSource) {
  for (const std::string format : {"folder", "video"}) {
    const std::string out = in(format);
    const fs::path sign = fs::path(out) / (format == "video" ? "frames_depth.mkv" : "000001_depth.png");
    const ProgramResult outcome = run_saccade(
        {"export", "synthetic:table?noise=kinect&frames=100000", "--out", out, "--format", format, "--json"},
        200, sign);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["status"], "interrupted");
    const auto frames = read_all(format == "video" ? out + "/frames_depth.mkv" : out);
    EXPECT_EQ(static_cast<std::int64_t>(frames.size()), report["frames"]);
  }
}

TEST_F(ExportTest, WrongUseIsOneLine) {
  const auto expect_error = [&](std::vector<std::string> arguments, int status, const char* part) {
    const ProgramResult outcome = run_saccade(arguments);
    EXPECT_EQ(outcome.status, status);
    EXPECT_TRUE(outcome.one_error_line()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  };
  expect_error({"export", kTable, "--out", in("x"), "--format", "avi"}, 2, "folder, tum, ply, pcd, video");
  expect_error({"export", kTable, "--out", in("x"), "--start", "99"}, 2, "past the last frame");
  expect_error({"export", in("absent.oni"), "--out", in("x")}, 3, "no such source");
  export_as(kTable, "folder", {"--frames", "1"});
  expect_error({"export", kTable, "--out", in("folder")}, 2, "not empty");
  expect_error({"export", kTable, "--out", "/dev/null/x"}, 1, "cannot make the output folder");
}

TEST_F(ExportTest, RecordTakesAPieceOfASource) {
  run({"record", kTable, in("piece.oni"), "--start", "3", "--every", "4", "--frames", "3"});
  const auto before = read_all(kTable), after = read_all(in("piece.oni"));
  ASSERT_EQ(after.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(cv::norm(before[3 + 4 * i].depth_mm, after[i].depth_mm, cv::NORM_INF), 0) << i;
}

TEST_F(ExportTest, CutCopiesAPieceBitForBit) {
  const auto before = read_all(kTable);
  const auto expect_piece = [&](const std::string& piece, std::size_t first, std::size_t count) {
    SCOPED_TRACE(piece);
    run({"oni", "cut", kTable, piece, in("cut.oni"), "--force"});
    run({"oni", "check", in("cut.oni")});
    const std::vector<Frame> expected(before.begin() + static_cast<std::ptrdiff_t>(first),
                                      before.begin() + static_cast<std::ptrdiff_t>(first + count));
    expect_same(expected, read_all(in("cut.oni")));
  };
  expect_piece("5..8", 5, 4);
  const double from = static_cast<double>(before[2].timestamp_us - before[0].timestamp_us) / 1e6;
  const double to = static_cast<double>(before[4].timestamp_us - before[0].timestamp_us) / 1e6;
  expect_piece(std::to_string(from - 0.001) + "s.." + std::to_string(to + 0.001) + "s", 2, 3);
  for (const char* wrong : {"5", "8..5", "a..b", "50..60"}) {
    const ProgramResult outcome = run_saccade({"oni", "cut", kTable, wrong, in("no.oni")});
    EXPECT_EQ(outcome.status, 2) << wrong;
    EXPECT_TRUE(outcome.one_error_line()) << outcome.err;
  }
}

// Each with as many threads as there are processors.
TEST_F(ExportTest, VideosHaveTheSameBytesOnAnyNumberOfProcessors) {
  export_as(kTable, "video", {"--frames", "3"});
  cpu_set_t all, first;
  CPU_ZERO(&first);
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  int processor = 0;
  while (!CPU_ISSET(processor, &all)) ++processor;
  CPU_SET(processor, &first);
  ASSERT_EQ(::sched_setaffinity(0, sizeof first, &first), 0);
  const ProgramResult outcome =
      run_saccade({"export", kTable, "--out", in("alone"), "--format", "video", "--frames", "3"});
  ASSERT_EQ(::sched_setaffinity(0, sizeof all, &all), 0);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"frames_depth.mkv", "frames_rgb.mkv"}) {
    const std::string bytes = text(std::string("video/") + name);
    EXPECT_GT(bytes.size(), 10'000U);
    EXPECT_TRUE(bytes == text(std::string("alone/") + name)) << name;
  }
}

// What other programs see, where they are installed.
TEST_F(ExportTest, FfmpegDecodesTheSameVideo) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  export_as(kTable, "video", {"--frames", "2"});
  ASSERT_EQ(run_program("ffmpeg", {"-v", "error", "-i", in("video/frames_depth.mkv"), "-f", "rawvideo",
                                   "-pix_fmt", "gray16le", in("raw")})
                .status,
            0);
  const auto raw = read_file(in("raw"));
  const auto before = read_all(kTable);
  const std::size_t pixels = before[0].depth_mm.total();
  ASSERT_EQ(raw.size(), 4 * pixels);
  for (std::size_t i = 0; i < 2 * pixels; ++i)
    ASSERT_EQ(static_cast<float>(raw[2 * i] | raw[2 * i + 1] << 8),
              before[i / pixels].depth_mm.begin()[static_cast<std::ptrdiff_t>(i % pixels)]);
}

TEST_F(ExportTest, OpenCvReadsTheSamePng) {
  if (std::system("/usr/bin/python3 -c 'import cv2' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3-opencv is not installed";
  export_as(kTable, "folder", {"--frames", "1"});
  const ProgramResult outcome = run_program(
      "/usr/bin/python3",
      {"-c", "import cv2, sys; i = cv2.imread(sys.argv[1], -1); print(i.dtype, i.sum(dtype='uint64'))",
       in("folder/000000_depth.png")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto frames = read_all(kTable);
  EXPECT_EQ(outcome.out,
            "uint16 " + std::to_string(static_cast<std::int64_t>(cv::sum(frames[0].depth_mm)[0])) + "\n");
}

// Points and colours as Open3D reads them: the depth is z, in mm and m.
TEST_F(ExportTest, Open3dReadsTheSameClouds) {
  if (std::system("/usr/bin/python3 -c 'import open3d' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3-open3d is not installed";
  export_as(kTable, "ply", {"--frames", "1"});
  export_as(kTable, "pcd", {"--frames", "1"});
  const char* script =
      "import numpy, open3d, sys\n"
      "for name in sys.argv[1:]:\n"
      "    cloud = open3d.io.read_point_cloud(name, remove_nan_points=True)\n"
      "    z = numpy.asarray(cloud.points)[:, 2] * (1000 if name.endswith('pcd') else 1)\n"
      "    rgb = numpy.rint(numpy.asarray(cloud.colors) * 255).astype(int)\n"
      "    print(len(z), int(numpy.rint(z).sum()), *rgb.sum(axis=0))\n";
  const ProgramResult outcome =
      run_program("/usr/bin/python3", {"-c", script, in("ply/000000_cloud.ply"), in("pcd/000000_cloud.pcd")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Frame frame = read_all(kTable).front();
  const cv::Mat points = frame.depth_mm > 0;
  const cv::Scalar bgr = cv::mean(frame.colour, points) * cv::countNonZero(points);
  const std::string line = fmt::format("{} {:.0f} {:.0f} {:.0f} {:.0f}\n", cv::countNonZero(points),
                                       cv::sum(frame.depth_mm)[0], bgr[2], bgr[1], bgr[0]);
  EXPECT_EQ(outcome.out, line + line);
}

}  // namespace
}  // namespace saccade
