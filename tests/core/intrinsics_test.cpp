#include "core/intrinsics.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(Intrinsics, GuessIsPrimeSenseScaledToTheWidth) {
  const Intrinsics camera = Intrinsics::guess_for({320, 240});
  EXPECT_DOUBLE_EQ(camera.fx, 262.5);
  EXPECT_DOUBLE_EQ(camera.cx, 159.5);
  EXPECT_DOUBLE_EQ(Intrinsics::guess_for({640, 360}).cy, 179.5) << "the middle, whatever the shape";
  EXPECT_EQ(Intrinsics::guess_for({8, 6}).fx, 6.5625) << "printed with few digits";
  EXPECT_EQ(camera.origin, IntrinsicsOrigin::guess);
}

TEST(Intrinsics, LevelsKeepTheRayOfEveryEvenPixel) {
  const Intrinsics camera{500, 510, 320, 239, IntrinsicsOrigin::file};
  const cv::Point3d p = camera.point_mm(64, 96, 1000), q = camera.at_level(3).point_mm(8, 12, 1000);
  EXPECT_DOUBLE_EQ(p.x, q.x);
  EXPECT_DOUBLE_EQ(p.y, q.y);
}

TEST(Intrinsics, FieldOfViewGivesTheAngleBack) {
  const Intrinsics camera = Intrinsics::from_field_of_view({640, 480}, 1.0, 0.8, IntrinsicsOrigin::sensor);
  EXPECT_NEAR(2 * std::atan(320 / camera.fx), 1.0, 1e-12);
  EXPECT_NEAR(2 * std::atan(240 / camera.fy), 0.8, 1e-12);
}

TEST(Intrinsics, NanAndNegativeFocalLengthsAreInvalid) {
  EXPECT_TRUE((Intrinsics{1, 1, 0, 0, {}}).valid());
  EXPECT_FALSE((Intrinsics{-1, 1, 0, 0, {}}).valid());
  EXPECT_FALSE((Intrinsics{1, std::numeric_limits<double>::quiet_NaN(), 0, 0, {}}).valid());
}

}  // namespace
}  // namespace saccade
