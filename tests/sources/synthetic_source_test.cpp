#include "sources/synthetic_source.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {
namespace {

using testing::HasSubstr;

Frame next(FrameSource& source) {
  Frame frame;
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
  return frame;
}

Frame frame_of(const std::string& uri, std::int64_t index) {
  SyntheticSource source(uri);
  source.seek(index);
  return next(source);
}

void expect_same_pixels(const Frame& a, const Frame& b) {
  EXPECT_EQ(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.colour, b.colour, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.truth.labels, b.truth.labels, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.truth.normals, b.truth.normals, cv::NORM_INF), 0);
}

TEST(SyntheticSpec, DefaultsAreAStillExactScene) {
  const SyntheticSpec spec = parse_synthetic("synthetic:cone");
  EXPECT_EQ(spec.scene, "cone");
  EXPECT_EQ(spec.seed, 0u);
  EXPECT_EQ(spec.noise, SyntheticSpec::Noise::none);
  EXPECT_EQ(spec.missing, 0);
  EXPECT_EQ(spec.frames, 90);
  EXPECT_EQ(spec.size, cv::Size(640, 480));
  EXPECT_EQ(spec.camera, scene::CameraPath::still);
  EXPECT_EQ(spec.rate_hz, 30);
  EXPECT_FALSE(spec.objects);
  EXPECT_FALSE(spec.distance_mm);
}

TEST(SyntheticSpec, ReadsEveryKey) {
  const SyntheticSpec spec = parse_synthetic(
      "synthetic:table?seed=9007199254740992&noise=kinect&missing=0.9&frames=1000000&size=8192x1&camera="
      "orbit&rate=0.5&"
      "objects=20&distance=812.5");
  EXPECT_EQ(spec.scene, "table");
  EXPECT_EQ(spec.seed, 9007199254740992u);
  EXPECT_EQ(spec.noise, SyntheticSpec::Noise::kinect);
  EXPECT_EQ(spec.missing, 0.9);
  EXPECT_EQ(spec.frames, 1'000'000);
  EXPECT_EQ(spec.size, cv::Size(8192, 1));
  EXPECT_EQ(spec.camera, scene::CameraPath::orbit);
  EXPECT_EQ(spec.rate_hz, 0.5);
  EXPECT_EQ(spec.objects, 20);
  EXPECT_EQ(spec.distance_mm, 812.5);
}

TEST(SyntheticSpec, NamesMistakesAndKnownWords) {
  const struct {
    const char *uri, *says, *hints;
  } kCases[] = {
      {"folder", "not a synthetic source", "synthetic:NAME"},
      {"synthetic:", "unknown scene ''", "cone, cube, cylinder, sphere, table, room"},
      {"synthetic:kitchen?seed=1", "unknown scene 'kitchen'", "cone, cube, cylinder, sphere, table, room"},
      {"synthetic:table?sed=1", "unknown key 'sed'",
       "seed, noise, missing, frames, scenes, size, camera, event, at, rate, objects, distance"},
      {"synthetic:table?", "unknown key ''", "known keys"},
      {"synthetic:table?seed=1&", "unknown key ''", "known keys"},
      {"synthetic:table?seed=1&seed=1", "'seed' is given twice", "once"},
      {"synthetic:table?seed", "bad value '' of key 'seed'", "an integer"},
      {"synthetic:table?seed=-1", "'-1'", "0.."},
      {"synthetic:table?seed=1.5", "'1.5'", "0.."},
      {"synthetic:table?seed=99999999999999999999", "'99999999999999999999'", "0.."},
      {"synthetic:table?noise=much", "'much'", "none or kinect"},
      {"synthetic:table?missing=0.91", "'0.91'", "0..0.9"},
      {"synthetic:table?frames=0", "'0'", "1..1000000"},
      {"synthetic:table?frames=1000001", "'1000001'", "1..1000000"},
      {"synthetic:table?scenes=0", "'0'", "1..1000000"},
      {"synthetic:table?size=640", "'640'", "640x480"},
      {"synthetic:table?size=640x", "'640x'", "640x480"},
      {"synthetic:table?size=0x480", "'0x480'", "1..8192"},
      {"synthetic:table?size=640x8193", "'640x8193'", "1..8192"},
      {"synthetic:table?camera=fly", "'fly'", "still, orbit, pan or walk"},
      {"synthetic:table?rate=0", "'0'", "0.1..1000"},
      {"synthetic:table?rate=nan", "'nan'", "0.1..1000"},
      {"synthetic:table?rate=30Hz", "'30Hz'", "0.1..1000"},
      {"synthetic:table?objects=0", "'0'", "1..20"},
      {"synthetic:table?objects=21", "'21'", "1..20"},
      {"synthetic:room?objects=5", "'5'", "table only"},
      {"synthetic:table?distance=399", "'399'", "400..10000"},
      {"synthetic:table?distance=inf", "'inf'", "400..10000"},
  };
  for (const auto& wrong : kCases) {
    SCOPED_TRACE(wrong.uri);
    try {
      parse_synthetic(wrong.uri);
      ADD_FAILURE() << "was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::usage);
      EXPECT_THAT(error.what(), HasSubstr(wrong.says));
      EXPECT_THAT(error.what(), HasSubstr(wrong.hints));
      EXPECT_THAT(error.what(), HasSubstr(wrong.uri));
    }
  }
}

TEST(SyntheticSource, DescribesItself) {
  const SyntheticSource source("synthetic:room?size=320x240&frames=7&rate=15");
  const SourceInfo& info = source.info();
  EXPECT_EQ(info.uri, "synthetic:room?size=320x240&frames=7&rate=15");
  EXPECT_EQ(info.kind, "synthetic");
  EXPECT_EQ(info.size, cv::Size(320, 240));
  EXPECT_EQ(info.frame_count, 7);
  EXPECT_EQ(info.rate_hz, 15);
  EXPECT_FALSE(info.live);
  EXPECT_EQ(info.intrinsics.fx, 262.5);
  EXPECT_EQ(info.intrinsics.cx, 159.5);
  EXPECT_EQ(info.intrinsics.cy, 119.5);
  EXPECT_EQ(info.intrinsics.origin, IntrinsicsOrigin::sensor);
}

TEST(SyntheticSource, GivesItsFramesInOrderThenEnds) {
  SyntheticSource source("synthetic:sphere?size=64x48&frames=4&rate=3");
  for (int i = 0; i < 4; ++i) {
    const Frame frame = next(source);
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.timestamp_us, std::llround(i * 1e6 / 3));
    EXPECT_EQ(frame.size(), cv::Size(64, 48));
    EXPECT_EQ(frame.colour.size(), frame.size());
    EXPECT_EQ(frame.truth.labels.size(), frame.size());
    EXPECT_EQ(frame.truth.normals.size(), frame.size());
    EXPECT_EQ(frame.intrinsics.fx, 52.5);
    EXPECT_GT(cv::countNonZero(frame.truth.labels), 100);
  }
  Frame frame;
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::end);
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::end);
  source.seek(3);
  EXPECT_EQ(next(source).index, 3);
  source.seek(4);
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::end);
  EXPECT_THROW(source.seek(-1), std::invalid_argument);
}

TEST(SyntheticSource, TheSameSpecificationGivesTheSameBitsInAnyOrder) {
  for (const std::string uri :
       {"synthetic:table?seed=3&noise=kinect&size=160x120", "synthetic:room?camera=orbit&size=160x120",
        "synthetic:cube?camera=orbit&noise=kinect&size=160x120"}) {
    SCOPED_TRACE(uri);
    SyntheticSource source(uri);
    for (int i = 0; i < 3; ++i) next(source);
    const Frame fourth = next(source);
    expect_same_pixels(fourth, frame_of(uri, 3));
    EXPECT_GT(cv::norm(fourth.depth_mm, frame_of(uri, 2).depth_mm, cv::NORM_INF), 0);
  }
}

TEST(SyntheticSource, AStillCameraWithoutNoiseSeesTheSameAlways) {
  const std::string uri = "synthetic:table?size=160x120";
  expect_same_pixels(frame_of(uri, 0), frame_of(uri, 89));
}

TEST(SyntheticSource, ScenesAreThoseOfTheNextSeeds) {
  const std::string uri = "synthetic:table?size=160x120&seed=5&scenes=3";
  SyntheticSource source(uri);
  for (const char* seed : {"5", "6", "7", "5"})
    expect_same_pixels(next(source), frame_of(std::string("synthetic:table?size=160x120&seed=") + seed, 0));
  expect_same_pixels(frame_of(uri, 2), frame_of("synthetic:table?size=160x120&seed=7", 0));
}

TEST(SyntheticSource, NoiseTouchesDepthAloneAndGroundTruthStaysExact) {
  const Frame exact = frame_of("synthetic:table?seed=1&size=160x120", 0),
              noisy = frame_of("synthetic:table?seed=1&size=160x120&noise=kinect", 0);
  EXPECT_GT(cv::norm(exact.depth_mm, noisy.depth_mm, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(exact.truth.normals, noisy.truth.normals, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(exact.truth.labels, noisy.truth.labels, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(exact.colour, noisy.colour, cv::NORM_INF), 0);
  int whole = 0, missing = 0;
  for (const float z : exact.depth_mm) whole += z == std::round(z);
  for (const float z : noisy.depth_mm) {
    ASSERT_EQ(z, std::round(z));
    ASSERT_GE(z, 0);
    missing += z == 0;
  }
  EXPECT_LT(whole, 400);  // exact depth is not rounded
  EXPECT_GT(missing, 100);
  EXPECT_LT(missing, 4000);
}

TEST(SyntheticSource, MissingStripsLeaveTheRestAsItIs) {
  for (const std::string uri :
       {"synthetic:room?seed=2&size=160x120", "synthetic:room?seed=2&size=160x120&noise=kinect"}) {
    SCOPED_TRACE(uri);
    const Frame whole = frame_of(uri, 1), frame = frame_of(uri + "&missing=0.3", 1);
    const cv::Mat kept = frame.depth_mm > 0;
    EXPECT_EQ(cv::norm(whole.depth_mm, frame.depth_mm, cv::NORM_INF, kept), 0);
    const int missing = 160 * 120 - cv::countNonZero(kept);
    EXPECT_GE(missing, 160 * 120 * 3 / 10);
    EXPECT_LE(missing, 160 * 120 * 3 / 10 + 2 * 12);  // part of one more strip of 5 x 15
    EXPECT_EQ(cv::norm(whole.truth.labels, frame.truth.labels, cv::NORM_INF), 0);
  }
}

TEST(SyntheticSource, MissingStripsBelongToTheScene) {
  const std::string uri = "synthetic:table?seed=5&missing=0.2&size=160x120";
  expect_same_pixels(frame_of(uri, 0), frame_of(uri, 7));
  expect_same_pixels(frame_of(uri + "&scenes=2", 1),
                     frame_of("synthetic:table?seed=6&missing=0.2&size=160x120", 0));
  const cv::Mat moved = (frame_of(uri, 0).depth_mm > 0) != (frame_of(uri + "&scenes=2", 1).depth_mm > 0);
  EXPECT_GT(cv::countNonZero(moved), 1000);
}

TEST(SyntheticSource, FramesReuseTheirMemory) {
  SyntheticSource source("synthetic:cone?size=64x48&noise=kinect&camera=orbit");
  Frame frame;
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
  const auto *depth = frame.depth_mm.data, *colour = frame.colour.data, *labels = frame.truth.labels.data,
             *normals = frame.truth.normals.data;
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm.data, depth);
  EXPECT_EQ(frame.colour.data, colour);
  EXPECT_EQ(frame.truth.labels.data, labels);
  EXPECT_EQ(frame.truth.normals.data, normals);
}

TEST(SyntheticSource, TinyAndOddSizesAreFilledToo) {
  for (const std::string size : {"1x1", "3x2", "17x301"}) {
    SCOPED_TRACE(size);
    const Frame frame = frame_of("synthetic:room?noise=kinect&missing=0.5&size=" + size, 1);
    EXPECT_EQ(frame.depth_mm.total(), frame.colour.total());
  }
}

}  // namespace
}  // namespace saccade
