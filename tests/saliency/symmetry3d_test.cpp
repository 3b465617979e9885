// Guarantees of the production form besides its values.

#include "saliency/symmetry3d.hpp"

#include <malloc.h>

#include <cstdlib>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "saliency/reference.hpp"
#include "shapes.hpp"
#include "tests/support/allocations.hpp"

namespace saccade::test {
namespace {

Symmetry3dParams three_levels() {
  Symmetry3dParams params;
  params.last_level = 2;
  return params;
}

SaliencyMaps compute(const cv::Mat1f& depth, const Symmetry3dParams& params, int workers = 1,
                     const std::string& simd = "auto", RequestedOutputs outputs = {}) {
  WorkerPool pool(workers);
  Symmetry3d op(params, pool, simd);
  SaliencyMaps maps;
  StageTimes times;
  op.compute(depth, camera_for(depth.size()), outputs, maps, times);
  return maps;
}

bool same_bits(const cv::Mat1f& a, const cv::Mat1f& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
           return std::memcmp(&x, &y, sizeof x) == 0;
         });
}

/// Sets the environment variable for as long as it lives.
class SimdEnvironment {
 public:
  explicit SimdEnvironment(const char* value) { setenv("SACCADE_SIMD", value, 1); }
  ~SimdEnvironment() { unsetenv("SACCADE_SIMD"); }
};

TEST(Symmetry3d, AnyNumberOfWorkersGivesTheSameBits) {
  const cv::Mat1f depth = ball_scene({203, 157}, 21);
  for (const std::string& simd : runnable_simd()) {
    const SaliencyMaps one = compute(depth, three_levels(), 1, simd);
    for (int workers = 2; workers <= 8; ++workers)
      EXPECT_TRUE(same_bits(one.master, compute(depth, three_levels(), workers, simd).master))
          << simd << ", " << workers << " workers";
  }
}

TEST(Symmetry3d, FramesBeforeDoNotMatter) {
  const cv::Mat1f first = ball_scene({150, 110}, 22), second = ball_scene({130, 120}, 23),
                  third = plane_depth({130, 120}, camera_for({130, 120}), {0, 0, 1}, 700);
  WorkerPool pool(2);
  Symmetry3d op(three_levels(), pool);
  SaliencyMaps maps;
  StageTimes times;
  for (const cv::Mat1f& depth : {first, second, third, second, first}) {
    op.compute(depth, camera_for(depth.size()), {}, maps, times);
    EXPECT_TRUE(same_bits(maps.master, compute(depth, three_levels()).master));
  }
}

TEST(Symmetry3d, AllocatesNothingAfterTheFirstFrame) {
  const cv::Mat1f first = ball_scene({160, 120}, 24), second = ball_scene({160, 120}, 25);
  WorkerPool pool(3);
  Symmetry3d op(three_levels(), pool);
  SaliencyMaps maps;
  StageTimes times;
  const RequestedOutputs outputs{.levels = true, .normals = true};
  op.compute(first, camera_for(first.size()), outputs, maps, times);
  const uchar* master = maps.master.data;
  const std::int64_t before = allocations();
  const std::size_t bytes_before = mallinfo2().uordblks + mallinfo2().hblkhd;
  op.compute(second, camera_for(second.size()), outputs, maps, times);
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(mallinfo2().uordblks + mallinfo2().hblkhd, bytes_before);
  EXPECT_EQ(maps.master.data, master);
}

TEST(Symmetry3d, NoReadingsGiveAMapOfZeros) {
  const SaliencyMaps maps = compute(cv::Mat1f(60, 80, 0.0f), three_levels(), 1, "auto", {true, true});
  EXPECT_EQ(cv::countNonZero(maps.master), 0);
  for (const cv::Mat1f& level : maps.levels) EXPECT_EQ(cv::countNonZero(level), 0);
  EXPECT_EQ(cv::norm(maps.normals), 0);
}

TEST(Symmetry3d, AFlatSceneGivesNearlyNothing) {
  const cv::Size size(120, 90);
  const cv::Mat1f frontal = plane_depth(size, camera_for(size), {0, 0, 1}, 1000),
                  tilted = plane_depth(size, camera_for(size), {0.3, -0.5, 0.8}, 1000);
  for (const std::string& simd : runnable_simd()) {
    EXPECT_LT(cv::norm(compute(frontal, three_levels(), 1, simd).master, cv::NORM_INF), 1e-9) << simd;
    // Rounding levels to 1/8 mm leaves a little roughness.
    EXPECT_LT(cv::norm(compute(tilted, three_levels(), 1, simd).master, cv::NORM_INF), 1e-4) << simd;
  }
}

TEST(Symmetry3d, InvalidValuesCountAsNoReading) {
  cv::Mat1f depth = ball_scene({80, 60}, 26);
  cv::Mat1f clean = depth.clone();
  const float strange[] = {-5, std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(), 70000};
  for (int i = 0; i < 40; ++i) {
    depth(i + 5, 2 * i) = strange[i % 4];
    clean(i + 5, 2 * i) = 0;
  }
  EXPECT_TRUE(same_bits(compute(depth, three_levels()).master, compute(clean, three_levels()).master));
}

TEST(Symmetry3d, NormalsAreThoseOfTheReference) {
  const cv::Mat1f depth = ball_scene({91, 67}, 27);
  const reference::Level expected = reference::make_level(to_double(depth), camera_for(depth.size()));
  Symmetry3dParams params = three_levels();
  for (params.first_level = 0; params.first_level < 2; ++params.first_level)
    for (const std::string& simd : runnable_simd()) {
      const cv::Mat3f normals = compute(depth, params, 1, simd, {.normals = true}).normals;
      ASSERT_EQ(normals.size(), depth.size());
      for (int r = 0; r < depth.rows; ++r)
        for (int c = 0; c < depth.cols; ++c)
          EXPECT_LT(cv::norm(cv::Vec3d(normals(r, c)) - expected.normals(r, c)), 5e-6)
              << simd << r << ' ' << c;
    }
}

TEST(Symmetry3d, GivesOnlyTheRequestedOutputs) {
  const SaliencyMaps maps = compute(ball_scene({80, 60}, 28), three_levels());
  EXPECT_TRUE(maps.levels.empty());
  EXPECT_TRUE(maps.normals.empty());
}

TEST(Symmetry3d, AddsToTheTimesOfItsStages) {
  WorkerPool pool(1);
  Symmetry3d op(three_levels(), pool);
  SaliencyMaps maps;
  StageTimes times;
  const cv::Mat1f depth = ball_scene({80, 60}, 29);
  op.compute(depth, camera_for(depth.size()), {}, maps, times);
  for (const Stage stage : {Stage::points, Stage::symmetry, Stage::master_map}) EXPECT_GT(times[stage], 0);
  EXPECT_EQ(times[Stage::attention], 0);
}

TEST(Symmetry3d, RestoresTheFloatingPointUnit) {
  compute(ball_scene({80, 60}, 30), three_levels());
  volatile float denormal = std::numeric_limits<float>::min();
  denormal = denormal / 4;
  EXPECT_GT(denormal, 0.0f);
}

TEST(Symmetry3d, TheEnvironmentLowersTheInstructionSet) {
  const cv::Mat1f depth = ball_scene({80, 60}, 31);
  const cv::Mat1f scalar = compute(depth, three_levels(), 1, "scalar").master;
  const SimdEnvironment lowered("scalar");
  EXPECT_TRUE(same_bits(compute(depth, three_levels()).master, scalar));
  for (const char* higher : {"scalar", "auto"})
    EXPECT_TRUE(same_bits(compute(depth, three_levels(), 1, higher).master, scalar));
}

TEST(Symmetry3d, TheEnvironmentDoesNotRaiseTheInstructionSet) {
  const cv::Mat1f depth = ball_scene({80, 60}, 32);
  const cv::Mat1f scalar = compute(depth, three_levels(), 1, "scalar").master;
  const std::string highest = runnable_simd().back();
  const SimdEnvironment raised(highest.c_str());
  EXPECT_TRUE(same_bits(compute(depth, three_levels(), 1, "scalar").master, scalar));
}

TEST(Symmetry3d, RefusesAnInstructionSetThatCannotRun) {
#if defined(__x86_64__)
  const char* foreign = "neon";
#else
  const char* foreign = "avx2";
#endif
  WorkerPool pool(1);
  try {
    const Symmetry3d op(three_levels(), pool, foreign);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
    EXPECT_NE(std::string(error.what()).find(foreign), std::string::npos);
  }
  const SimdEnvironment wrong("avx9000");
  EXPECT_THROW(Symmetry3d(three_levels(), pool), Error);
}

TEST(Symmetry3d, RefusesLevelsThatAreTooSmall) {
  WorkerPool pool(1);
  Symmetry3d op(three_levels(), pool);
  SaliencyMaps maps;
  StageTimes times;
  const cv::Mat1f depth(20, 40, 1000.0f);
  EXPECT_THROW(op.compute(depth, camera_for(depth.size()), {}, maps, times), Error);
}

TEST(Symmetry3d, RefusesAnInvalidCamera) {
  WorkerPool pool(1);
  Symmetry3d op(three_levels(), pool);
  SaliencyMaps maps;
  StageTimes times;
  EXPECT_THROW(op.compute(cv::Mat1f(60, 80, 1000.0f), Intrinsics{}, {}, maps, times), std::invalid_argument);
}

}  // namespace
}  // namespace saccade::test
