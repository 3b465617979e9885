#include "models/combined.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "displays.hpp"
#include "models/image.hpp"
#include "models/itti.hpp"
#include "models/symmetry2d.hpp"

namespace saccade {
namespace {

// A ball on a wall that faces the camera, on the left, and a red disc on the wall, on the right.
Frame ball_and_picture(float wall_mm) {
  Frame frame = frame_of(cv::Mat3b(240, 320, cv::Vec3b(90, 90, 90)));
  cv::circle(frame.colour, {240, 120}, 20, {40, 40, 220}, cv::FILLED);
  const float radius_px = 30;
  for (int r = 0; r < 240; ++r)
    for (int c = 0; c < 320; ++c) {
      const float inside =
          radius_px * radius_px - static_cast<float>((r - 120) * (r - 120) + (c - 80) * (c - 80));
      const float mm_per_px = wall_mm / static_cast<float>(frame.intrinsics.fx);
      frame.depth_mm(r, c) = wall_mm - (inside > 0 ? std::sqrt(inside) * mm_per_px : 0);
    }
  return frame;
}

// The ball has the colour of the wall, the disc its depth.
TEST(Combined, PrefersTheSolidOverThePictureAtAnyDistance) {
  for (const float wall_mm : {600.0F, 1500.0F, 3000.0F}) {
    const cv::Mat1f map = map_of("combined", ball_and_picture(wall_mm));
    EXPECT_LT(maximum_of(map).x, 160) << wall_mm;
    EXPECT_LE(map(maximum_of(map)), 1) << wall_mm;
  }
}

// Two things that look alike, one of them flat.
TEST(Combined, PrefersTheSolidOfTwoThingsThatLookAlike) {
  Frame frame = ball_and_picture(1500);
  cv::circle(frame.colour, {80, 120}, 20, {40, 40, 220}, cv::FILLED);
  const cv::Mat1f map = map_of("combined", frame);
  EXPECT_GT(map(120, 80), 2 * map(120, 240));
}

TEST(Combined, SeesBothAtAnyDistance) {
  for (const float wall_mm : {600.0F, 1500.0F, 3000.0F}) {
    const cv::Mat1f map = map_of("combined", ball_and_picture(wall_mm));
    const float elsewhere = map(20, 160), ball = map(120, 80), picture = map(120, 240);
    EXPECT_GT(ball, 3 * elsewhere) << wall_mm;
    EXPECT_GT(picture, 3 * elsewhere) << wall_mm;
  }
}

TEST(Combined, WithoutDepthIsTheImageAlone) {
  Frame frame = ball_and_picture(1000);
  frame.depth_mm.setTo(0);
  const cv::Point at = maximum_of(map_of("combined", frame));
  EXPECT_LT(std::hypot(at.x - 240, at.y - 120), 24) << at;
}

// Each step of the header in double, from the maps of the single models.
TEST(Combined, IsTheEquationOfItsMaps) {
  const Frame frame = ball_and_picture(1100);
  WorkerPool pool(1);
  SaliencyMaps maps;
  StageTimes times;
  make_model(settings_for("symmetry3d"), pool)->compute(frame, {.levels = true}, maps, times);
  cv::Mat1d noise_aware(frame.size(), 0.0);
  for (std::size_t l = 0; l < maps.levels.size(); ++l) {
    cv::Mat1d weighted(maps.levels[l].size());
    for (int r = 0; r < weighted.rows; ++r)
      for (int c = 0; c < weighted.cols; ++c) {
        const double x = static_cast<double>(frame.depth_mm(r << l, c << l)) / (500 << l);
        weighted(r, c) = static_cast<double>(maps.levels[l](r, c)) / (1 + x * x);
      }
    cv::Mat1d full(frame.size());
    for (int r = 0; r < full.rows; ++r)
      for (int c = 0; c < full.cols; ++c) {
        const int step = 1 << l, r0 = r / step, c0 = c / step;
        const int r1 = std::min(r0 + 1, weighted.rows - 1), c1 = std::min(c0 + 1, weighted.cols - 1);
        const double v = static_cast<double>(r % step) / step, u = static_cast<double>(c % step) / step;
        full(r, c) = (1 - v) * ((1 - u) * weighted(r0, c0) + u * weighted(r0, c1)) +
                     v * ((1 - u) * weighted(r1, c0) + u * weighted(r1, c1));
      }
    noise_aware += full;
  }
  const auto halve = [](const cv::Mat1d& map) {
    cv::Mat1d half;
    cv::pyrDown(map, half);
    return half;
  };
  const auto smooth = [](cv::Mat1d map) {
    cv::GaussianBlur(map, map, {}, 1.5);
    double highest = 0;
    cv::minMaxLoc(map, nullptr, &highest);
    return as_double(map, 1 / highest);
  };
  const cv::Mat1d depth_part = smooth(halve(halve(noise_aware)));
  cv::Mat3b half_colour;
  cv::pyrDown(frame.colour, half_colour);
  IttiModel itti("itti", false, pool, 1);
  cv::Mat1f of_itti(depth_part.size());
  const cv::Mat1f& conspicuity = itti.find_conspicuity(half_colour);
  upsample_rows(conspicuity, itti.map_level() - 1, of_itti, false, 0, of_itti.rows);
  const cv::Mat1d of_symmetry2d = as_double(make_symmetry2d(pool, 4)->find_symmetry(half_colour));
  cv::Mat1d image;
  cv::scaleAdd(smooth(of_symmetry2d), 0.25, smooth(as_double(of_itti)), image);
  double highest = 0;
  cv::minMaxLoc(image, nullptr, &highest);
  image /= highest;
  const cv::Mat1f map = map_of("combined", frame);
  for (int r = 0; r < image.rows; ++r)
    for (int c = 0; c < image.cols; ++c) {
      const double x = depth_part(r, c);
      const double expected = (1 - (1 - 0.5 * x) * (1 - image(r, c))) * (0.35 + 0.65 * x / (x + 0.002));
      ASSERT_NEAR(static_cast<double>(map(4 * r, 4 * c)), expected, 1e-3) << r << " " << c;
    }
}

}  // namespace
}  // namespace saccade
