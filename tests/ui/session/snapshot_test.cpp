#include "ui/session/snapshot.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "output/fixations_json.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

class SnapshotTest : public FolderTest {
 protected:
  SnapshotTest() {
    result_.frame.index = 7;
    result_.frame.depth_mm = cv::Mat1f(48, 64, 1000.0F);
    result_.frame.colour = cv::Mat3b(48, 64, cv::Vec3b(10, 20, 30));
    result_.frame.intrinsics = Intrinsics::guess_for({64, 48});
    result_.maps.master = cv::Mat1f(48, 64, 0.0F);
    result_.maps.master(20, 30) = 1.25F;
    result_.attention.fixations.push_back({20, 30, 1.25F, {1, 2, 3}, {}});
  }
  ViewResult view_;
  Result& result_ = view_.a.result;
};

TEST_F(SnapshotTest, HoldsOverlayMapAndFixations) {
  const OverlayStyle style{.map = {.palette = Palette::inferno}, .marks = false};
  const auto folder = write_snapshot(folder_ / "new", view_, style, std::chrono::system_clock::now());
  const cv::Mat1f map = cv::imread((folder / "000007_saliency.tiff").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(map, result_.maps.master), 0);
  const cv::Mat3b overlay = cv::imread((folder / "000007_overlay.png").string());
  EXPECT_EQ(cv::norm(overlay, draw_overlay(result_.frame, result_.maps.master, result_.attention, style)), 0);
  const cv::Mat1w depth = cv::imread((folder / "000007_depth.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::countNonZero(depth != 1000), 0);
  const cv::Mat3b colour = cv::imread((folder / "000007_rgb.png").string());
  EXPECT_EQ(cv::norm(colour, result_.frame.colour), 0);
  const auto ply = read_file(folder / "000007_cloud.ply");
  const std::string header(ply.begin(), ply.begin() + 200);
  EXPECT_NE(header.find("element vertex 3072"), std::string::npos) << header;
  const auto json = read_file(folder / "000007_fixations.json");
  EXPECT_EQ(std::string(json.begin(), json.end()), fixations_json(result_) + "\n");
}

TEST_F(SnapshotTest, OfAComparisonBothSidesAreKeptWithTheirSettings) {
  view_.compared = true;
  view_.a.settings.kernel = 31;
  view_.b.result = view_.a.result;
  view_.b.result.maps.master = cv::Mat1f(48, 64, 0.5F);
  view_.b.settings.model = "centre";
  const auto folder = write_snapshot(folder_, view_, {}, std::chrono::system_clock::now());
  for (const auto& [name, side] : {std::pair("a", &view_.a), std::pair("b", &view_.b)}) {
    const auto file = (folder / name / "000007_saliency.tiff").string();
    EXPECT_EQ(cv::norm(cv::imread(file, cv::IMREAD_UNCHANGED), side->result.maps.master), 0);
    Settings settings;
    load_settings(settings, (folder / name / "settings.toml").string());
    EXPECT_EQ(settings.kernel, side->settings.kernel);
    EXPECT_EQ(settings.model, side->settings.model);
  }
}

TEST_F(SnapshotTest, NamesAreNeverUsedTwice) {
  const auto now = std::chrono::system_clock::now();
  const auto first = write_snapshot(folder_, view_, {}, now),
             second = write_snapshot(folder_, view_, {}, now);
  EXPECT_EQ(second.string(), first.string() + "-2");
  write_file(unused_path(folder_, "rec", ".oni", now), "x");
  EXPECT_TRUE(unused_path(folder_, "rec", ".oni", now).string().ends_with("-2.oni"));
}

TEST_F(SnapshotTest, AFolderThatCannotBeMadeIsAnError) {
  write_file(folder_ / "file", "x");
  EXPECT_THROW(write_snapshot(folder_ / "file", view_, {}, {}), Error);
}

}  // namespace
}  // namespace saccade
