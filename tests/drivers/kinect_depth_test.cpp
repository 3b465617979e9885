#include "drivers/modules/kinect_depth.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace saccade {
namespace {

// The shift of a dot, by the geometry of the camera alone: a ray from the projector through the dot at depth
// Z meets the reference plane Z0 somewhere else than the ray of the camera does.
double raw_of_depth(double depth_cm, const KinectGeometry& g) {
  const double dot_x = 1.7 * depth_cm;       // any direction from the camera
  const double projector_x = g.baseline_cm;  // the projector stands beside the camera
  const double stored_x = projector_x + (dot_x - projector_x) * g.reference_distance_cm / depth_cm;
  const double seen_x = dot_x * g.reference_distance_cm / depth_cm;
  const double shift_px = (stored_x - seen_x) / g.reference_pixel_cm;
  return 4 * (shift_px + g.constant_shift + 3.0 / 8);
}

TEST(KinectDepth, InvertsTheGeometryOfProjectorAndCamera) {
  const KinectGeometry typical, other{8, 130, 0.11, 190};
  for (const KinectGeometry& geometry : {typical, other})
    for (const double depth_cm : {50.0, 80.0, 120.0, 200.0, 400.0, 900.0}) {
      const double raw = raw_of_depth(depth_cm, geometry);
      const auto below = static_cast<int>(std::floor(raw));
      const double share = raw - below;  // between two whole values the depth is nearly linear in 1/Z
      const double inverse =
          (1 - share) / kinect_depth_mm(below, geometry) + share / kinect_depth_mm(below + 1, geometry);
      EXPECT_NEAR(1 / inverse, 10 * depth_cm, 1e-6 * depth_cm);
    }
}

TEST(KinectDepth, TheReferencePlaneIsWhereItIs) {
  const KinectGeometry geometry;
  EXPECT_NEAR((kinect_depth_mm(801, geometry) + kinect_depth_mm(802, geometry)) / 2, 1200, 0.05);
}

// Measured with tape by the authors of the first Kinect driver: 1 / (3.33 - 0.00307 raw) metres, good
// to a few per cent.
TEST(KinectDepth, AgreesWithMeasurements) {
  for (int raw = 500; raw <= 1000; raw += 50) {
    const double measured_mm = 1000 / (3.3309495161 - 0.0030711016 * raw);
    EXPECT_NEAR(kinect_depth_mm(raw, {}), measured_mm, 0.06 * measured_mm) << raw;
  }
}

TEST(KinectDepth, TheTableHoldsRoundedDepthsAndNoOthers) {
  const auto table = kinect_depth_table({});
  EXPECT_EQ(table[2047], 0);
  for (int raw = 0; raw < 2047; ++raw) {
    const double mm = kinect_depth_mm(raw, {});
    const bool reading = mm > 0.5 && mm < 10000.5;
    EXPECT_NEAR(table[static_cast<std::size_t>(raw)], reading ? mm : 0, 0.5) << raw;
  }
  int previous = 0;
  for (int raw = 0; raw < 1100 && table[static_cast<std::size_t>(raw)] > 0; ++raw) {
    EXPECT_GE(table[static_cast<std::size_t>(raw)], previous);
    previous = table[static_cast<std::size_t>(raw)];
  }
  EXPECT_GT(previous, 9000);
}

TEST(KinectDepth, FocalLengthOfTheInfraredCamera) { EXPECT_NEAR(kinect_focal_px({}), 575.8, 0.1); }

TEST(KinectClock, ContinuesWhenTheTicksWrap) {
  KinectClock clock;
  const std::uint64_t begin = clock.microseconds(4'294'000'000U);
  std::uint64_t ticks = 4'294'000'000U;
  for (int k = 1; k <= 200; ++k) {
    ticks += 2'000'000;
    EXPECT_EQ(clock.microseconds(static_cast<std::uint32_t>(ticks)) - begin,
              ticks / 60 - 4'294'000'000U / 60);
  }
}

TEST(KinectClock, TakesFramesInEitherOrder) {
  KinectClock clock;
  const std::uint64_t begin = clock.microseconds(600);
  EXPECT_EQ(clock.microseconds(0), begin - 10);
  EXPECT_EQ(clock.microseconds(4'294'966'696U), begin - 20);
  EXPECT_EQ(clock.microseconds(600), begin);
}

}  // namespace
}  // namespace saccade
