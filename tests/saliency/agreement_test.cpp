// The production form against the reference, on every instruction set of this machine.

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "comparison.hpp"
#include "shapes.hpp"
#include "tests/support/places.hpp"

namespace saccade::test {
namespace {

Symmetry3dParams params_of(int kernel, int first_level, int last_level) {
  Symmetry3dParams params;
  params.kernel = kernel;
  params.first_level = first_level;
  params.last_level = last_level;
  return params;
}

void compare(const cv::Mat1f& depth, const Symmetry3dParams& params, double excused = 0.001,
             double noticed = 1e-5) {
  const Comparison comparison(depth, camera_for(depth.size()), params);
  for (const std::string& simd : runnable_simd()) comparison.check(simd, excused, noticed);
}

class Kernel : public testing::TestWithParam<int> {};

TEST_P(Kernel, AgreesWithTheReference) { compare(ball_scene({75, 58}), params_of(GetParam(), 0, 1)); }

INSTANTIATE_TEST_SUITE_P(Small, Kernel, testing::Range(3, 32));
INSTANTIATE_TEST_SUITE_P(Large, Kernel, testing::Values(32, 41, 63, 64, 100, 127));

class Size : public testing::TestWithParam<cv::Size> {};

TEST_P(Size, AgreesWithTheReference) {
  // A few pixels are excused: one near-tie is more than 0.1 % of a tiny image.
  const double excused = std::max(0.001, 8.0 / GetParam().area());
  compare(ball_scene(GetParam(), 3), params_of(15, 0, 0), excused);
  compare(ball_scene(GetParam(), 4), params_of(5, 0, 0), excused);
}

INSTANTIATE_TEST_SUITE_P(Odd, Size,
                         testing::Values(cv::Size(8, 8), cv::Size(9, 8), cv::Size(8, 9), cv::Size(13, 11),
                                         cv::Size(15, 33), cv::Size(16, 16), cv::Size(17, 9), cv::Size(31, 8),
                                         cv::Size(33, 21), cv::Size(47, 30), cv::Size(101, 23)));

TEST(Agreement, AllFiveLevels) { compare(ball_scene({190, 141}, 5), params_of(15, 0, 4)); }

TEST(Agreement, LevelsThatDoNotBeginAtZero) { compare(ball_scene({165, 97}, 6), params_of(9, 1, 3)); }

TEST(Agreement, MillimetreLengthScale) {
  Symmetry3dParams params = params_of(15, 0, 2);
  params.length_scale = LengthScale::millimetre;
  compare(ball_scene({120, 90}, 7), params);
}

TEST(Agreement, NormalisedByMaximum) {
  Symmetry3dParams params = params_of(11, 0, 2);
  params.normalisation = LevelNormalisation::max;
  compare(ball_scene({110, 85}, 8), params);
}

TEST(Agreement, NormalisedAfterItti) {
  Symmetry3dParams params = params_of(11, 0, 2);
  params.normalisation = LevelNormalisation::itti;
  compare(ball_scene({110, 85}, 9), params);
}

TEST(Agreement, DepthInStepsThatAreNoEighths) {
  compare(ball_scene({90, 70}, 10, 0.2f), params_of(15, 0, 2));
}

// Sums of such depths are rounded to 1/256 mm.
TEST(Agreement, ContinuousDepth) {
  compare(ball_scene({90, 70}, 11, 1e-3f), params_of(15, 0, 1), 0.001, 5e-5);
}

TEST(Agreement, RowsAndBlocksWithoutReadings) {
  cv::Mat1f depth = ball_scene({97, 71}, 12);
  depth.rowRange(20, 31) = 0;
  depth.row(50) = 0;
  depth(cv::Rect(40, 33, 35, 38)) = 0;
  compare(depth, params_of(15, 0, 2));
}

TEST(Agreement, SinglePixelsFarFromEachOther) {
  cv::Mat1f depth(64, 64, 0.0f);
  for (int r = 2; r < 64; r += 5)
    for (int c = 1; c < 64; c += 7) depth(r, c) = static_cast<float>(900 + 3 * r + c);
  compare(depth, params_of(15, 0, 1));
}

TEST(Agreement, FarScenesTo65535Millimetres) {
  cv::Mat1f depth = ball_scene({80, 60}, 13);
  depth *= 30;  // 24 to 65 m
  for (float& z : depth) z = std::min(z, 65535.0f);
  compare(depth, params_of(15, 0, 1));
  compare(depth, params_of(31, 0, 1));
}

TEST(Agreement, MiddleDistances) {
  cv::Mat1f depth = ball_scene({80, 60}, 14);
  depth *= 12;  // 10 to 25 m
  compare(depth, params_of(15, 0, 1));
}

TEST(Agreement, NearestAndFarthestReadingsSideBySide) {
  cv::Mat1f depth = ball_scene({80, 60}, 15);
  for (int r = 5; r < 60; r += 9)
    for (int c = 3; c < 80; c += 11)
      depth(cv::Rect(c, r, 4, 4) & cv::Rect(0, 0, 80, 60)) = (r + c) % 2 ? 1 : 65535;
  compare(depth, params_of(15, 0, 1));
}

TEST(Agreement, EverythingAtOneMillimetre) { compare(cv::Mat1f(24, 37, 1.0f), params_of(15, 0, 0)); }

// The excuse for near-ties must not excuse errors.
TEST(Agreement, AnErrorIsNoNearTie) {
  for (const int kernel : {5, 15}) {
    const Symmetry3dParams params = params_of(kernel, 0, 0);
    const cv::Mat1f depth = ball_scene({110, 85}, 16);
    const reference::Level level = reference::make_level(to_double(depth), camera_for(depth.size()));
    int missed = 0, all = 0;
    for (int r = 0; r < depth.rows; r += 3)
      for (int c = 0; c < depth.cols; c += 5) {
        const auto pixel = reference::symmetry_at(level, r, c, params);
        if (!pixel) continue;
        EXPECT_EQ(judge(level, r, c, params, pixel->score(), 1e-5), Answer::right);
        ++all;
        missed += judge(level, r, c, params, pixel->score() + 0.003, 1e-4) != Answer::wrong;
      }
    EXPECT_GT(all, 300);
    EXPECT_LE(missed, all / 50) << "of " << all << ", k = " << kernel;
  }
}

// A point exactly on a plane is in neither half in the reference, and in the one behind in the production
// form. Here entire rows and columns lie on the planes, and it makes no difference.
TEST(Agreement, PointsExactlyOnThePlanes) {
  cv::Mat1f depth(40, 51, 1000.0f);
  compare(depth, params_of(9, 0, 0));
  degrade(depth, 17, 1000, 0.1);  // the same plane with holes
  compare(depth, params_of(9, 0, 0));
}

// The tests below use real images, cut to a size that the reference can process.
class RealImage : public testing::TestWithParam<const char*> {};

TEST_P(RealImage, AgreesWithTheReference) {
  const std::filesystem::path path = in_shared(std::string("data/") + GetParam());
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(image.type(), CV_16UC1);
  cv::Mat1f depth;
  image.convertTo(depth, CV_32F);
  const cv::Rect part(depth.cols / 2 - 100, depth.rows / 2 - 40, 171, 139);
  const cv::Mat1f cut = depth(part).clone();
  Intrinsics camera = Intrinsics::guess_for(depth.size());
  camera.cx -= part.x;
  camera.cy -= part.y;
  for (const LengthScale scale : {LengthScale::relative, LengthScale::millimetre}) {
    Symmetry3dParams params = params_of(15, 0, 3);
    params.length_scale = scale;
    const Comparison comparison(cut, camera, params);
    for (const std::string& simd : runnable_simd()) comparison.check(simd);
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, RealImage,
                         testing::Values("osd_learn/0003_depth.png", "osd_full/0001_depth.png",
                                         "rooms_avd/0005_depth.png", "kitchen_sequence/0020_depth.png"));

}  // namespace
}  // namespace saccade::test
