#include "saliency/probe.hpp"

#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shapes.hpp"

namespace saccade::test {
namespace {

constexpr double kSame = 1e-9;

// Corners, borders and random pixels.
std::vector<cv::Point> some_pixels(cv::Size size) {
  std::vector<cv::Point> pixels = {{0, 0},
                                   {size.width - 1, 0},
                                   {0, size.height - 1},
                                   {size.width - 1, size.height - 1},
                                   {size.width / 2, size.height - 1}};
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i)
    pixels.emplace_back(static_cast<int>(random() % static_cast<unsigned>(size.width)),
                        static_cast<int>(random() % static_cast<unsigned>(size.height)));
  return pixels;
}

// Checks every number of the probe against the maps of the entire image.
void check_against_maps(const cv::Mat1f& depth, const Symmetry3dParams& params) {
  const cv::Size size = depth.size();
  const Intrinsics camera = camera_for(size);
  const reference::Result whole = reference::symmetry3d(depth, camera, params);
  const reference::Level level0 = reference::make_level(to_double(depth), camera);
  std::vector<double> weights;
  for (const cv::Mat1d& map : whole.levels)
    weights.push_back(reference::level_weight(map, params.normalisation));

  int scoring = 0;
  for (const cv::Point& at : some_pixels(size)) {
    SCOPED_TRACE(testing::Message() << "pixel " << at << ", kernel " << params.kernel);
    const Probe probed = probe(depth, camera, params, at.y, at.x, weights);
    EXPECT_NEAR(probed.saliency, whole.master(at), kSame);
    EXPECT_EQ(probed.depth_mm, static_cast<double>(depth(at)));
    EXPECT_EQ(probed.normal.value_or(cv::Vec3d()), level0.normals(at));
    EXPECT_EQ(cv::Vec3d(probed.position_mm), level0.points_mm(at));
    ASSERT_EQ(probed.levels.size(), whole.levels.size());
    for (std::size_t i = 0; i < whole.levels.size(); ++i) {
      const LevelProbe& level = probed.levels[i];
      EXPECT_EQ(level.level, params.first_level + static_cast<int>(i));
      EXPECT_NEAR(level.score, whole.levels[i](level.pixel), kSame);
      EXPECT_EQ(level.winner().has_value(), level.score > 0);
      if (level.winner()) {
        EXPECT_EQ(level.symmetry->planes[*level.winner()].score, level.score);
        ++scoring;
      }
    }
    if (params.first_level == 0) {
      EXPECT_EQ(probed.levels[0].pixel, at);
    }
  }
  EXPECT_GE(scoring, 5) << "the scene has something to find";
}

TEST(Probe, IsTheReferenceAtOnePixel) {
  check_against_maps(ball_scene({128, 96}), {.kernel = 15, .first_level = 0, .last_level = 3});
  check_against_maps(ball_scene({97, 73}), {.kernel = 5, .first_level = 0, .last_level = 2});
}

TEST(Probe, WindowsLargerThanTheImageAndLevelsThatBeginLate) {
  // A ridge, since wide windows of a cluttered scene see nothing convex.
  cv::Mat1f ridge = ridge_depth({64, 48}, camera_for({64, 48}), 1000, 0.5);
  degrade(ridge, 1);
  check_against_maps(ridge, {.kernel = 127, .first_level = 0, .last_level = 1});
  ridge = ridge_depth({131, 90}, camera_for({131, 90}), 1000, 0.5);
  degrade(ridge, 2);
  check_against_maps(
      ridge, {.kernel = 9, .first_level = 2, .last_level = 3, .length_scale = LengthScale::millimetre});
}

TEST(Probe, WeightsOfTheLevels) {
  check_against_maps(
      ball_scene({96, 72}),
      {.kernel = 9, .first_level = 0, .last_level = 2, .normalisation = LevelNormalisation::max});
}

TEST(Probe, FootprintGrowsWithLevelAndDepth) {
  const cv::Size size(160, 120);
  const Intrinsics camera = camera_for(size);
  const cv::Mat1f depth(size, 1000.0F);
  const Probe probed = probe(depth, camera, {.kernel = 15, .first_level = 0, .last_level = 3}, 60, 80);
  EXPECT_EQ(probed.levels[0].footprint_px, cv::Rect2d(72.5, 52.5, 15, 15));
  EXPECT_EQ(probed.levels[3].pixel, cv::Point(10, 8)) << "60 / 8 is between 7 and 8";
  EXPECT_EQ(probed.levels[3].footprint_px, cv::Rect2d(80 - 60, 64 - 60, 120, 120));
  EXPECT_NEAR(probed.levels[0].footprint_mm, 15 / camera.fx * 1000, kSame);
  EXPECT_NEAR(probed.levels[3].footprint_mm, 8 * 15 / camera.fx * 1000, kSame);
}

TEST(Probe, SaysWhyAPlaneScoresNothing) {
  const cv::Size size(64, 48);
  const Intrinsics camera = camera_for(size);
  const Symmetry3dParams params{.kernel = 9, .first_level = 0, .last_level = 0};
  const auto verdicts = [&](const cv::Mat1f& depth, int row, int col) {
    std::vector<reference::PlaneVerdict> all;
    const Probe probed = probe(depth, camera, params, row, col);
    for (const auto& plane : probed.levels[0].symmetry.value().planes) all.push_back(plane.verdict);
    return all;
  };
  using enum reference::PlaneVerdict;
  EXPECT_THAT(verdicts(ridge_depth(size, camera, 1000, 0.8), 24, 32), testing::Contains(scores));
  EXPECT_THAT(verdicts(ridge_depth(size, camera, 1000, -0.8), 24, 32), testing::Contains(not_convex));
  EXPECT_THAT(verdicts(ridge_depth(size, camera, 1000, -0.8), 24, 32),
              testing::Not(testing::Contains(scores)));

  cv::Mat1f lonely(size, 0.0F);  // a column of 3 pixels is all there is; nothing lies on one side
  lonely(cv::Rect(0, 20, 2, 2)) = 1000.0F;
  EXPECT_THAT(verdicts(lonely, 20, 0), testing::Contains(half_empty));
}

TEST(Probe, ReportsNoReadingAndNoNormal) {
  const cv::Size size(64, 48);
  cv::Mat1f depth(size, 1000.0F);
  depth(cv::Rect(20, 20, 9, 9)) = 0;
  depth(24, 24) = 1000;  // alone: a depth, but no normal
  const Symmetry3dParams params{.kernel = 9, .first_level = 0, .last_level = 1};
  const Probe hole = probe(depth, camera_for(size), params, 22, 22);
  EXPECT_EQ(hole.depth_mm, 0);
  EXPECT_EQ(hole.levels[0].footprint_mm, 0);
  EXPECT_FALSE(hole.levels[0].symmetry.has_value());
  const Probe alone = probe(depth, camera_for(size), params, 24, 24);
  EXPECT_EQ(alone.depth_mm, 1000);
  EXPECT_FALSE(alone.normal.has_value());
  EXPECT_FALSE(alone.levels[0].symmetry.has_value());
}

TEST(Probe, RefusesWhatItCannotProbe) {
  const cv::Mat1f depth(48, 64, 1000.0F);
  const Intrinsics camera = camera_for(depth.size());
  EXPECT_THROW(probe(depth, camera, {.last_level = 0}, 48, 0), std::invalid_argument);
  EXPECT_THROW(probe(depth, camera, {.last_level = 0}, 0, -1), std::invalid_argument);
  EXPECT_THROW(probe(depth, camera, {.last_level = 1}, 0, 0, std::vector<double>{1}), std::invalid_argument);
  EXPECT_THROW(probe(depth, camera, {.last_level = 4}, 0, 0), Error);
}

}  // namespace
}  // namespace saccade::test
