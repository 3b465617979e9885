// The viewer's session with real threads; everything waits for what it tests, with a generous limit.
#include "ui/session/session.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;
using Phase = SessionState::Phase;

// A ball before a wall, a hundred frames a second; the wall is at 1000 + index mm. Some files fail.
class BallSource : public FrameSource {
 public:
  explicit BallSource(const std::string& uri) {
    info_.uri = uri;
    info_.size = {64, 48};
    info_.frame_count = 30;
    info_.intrinsics = Intrinsics::guess_for(info_.size);
  }
  const SourceInfo& info() const override { return info_; }
  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (next_ >= *info_.frame_count) return {ReadStatus::end, ""};
    frame.index = next_++;
    frame.timestamp_us = frame.index * 10'000;
    frame.intrinsics = info_.intrinsics;
    frame.depth_mm.create(info_.size);
    frame.depth_mm.setTo(1000 + static_cast<double>(frame.index));
    frame.colour.release();
    for (int r = 14; r < 34; ++r)
      for (int c = 22; c < 42; ++c)
        frame.depth_mm(r, c) -= static_cast<float>(std::max(0.0, 100 - std::hypot(r - 24, c - 32) * 9));
    if (info_.uri == "breaks" && frame.index == 3) throw failed("the device is gone", "breaks", "plug it in");
    return {ReadStatus::frame, ""};
  }
  void seek(std::int64_t index) override { next_ = index; }

 private:
  SourceInfo info_;
  std::int64_t next_ = 0;
};

class SessionTest : public ::testing::Test {
 protected:
  std::unique_ptr<Session> make() {
    ComputeRequest request;
    request.a.workers = 2;
    request.a.kernel = 7;
    return std::make_unique<Session>(
        [](const std::string& uri, auto&&...) -> std::unique_ptr<FrameSource> {
          if (uri == "absent") throw unreadable("no such source", uri, "try another");
          return std::make_unique<BallSource>(uri);
        },
        [this] { ++woken_; }, request);
  }

  // Waits until `condition` holds, and returns whether it did within a minute.
  static bool wait_for(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  std::atomic<int> woken_ = 0;
};

TEST_F(SessionTest, ComputesAndWakes) {
  const auto session = make();
  EXPECT_EQ(session->state().phase, Phase::idle);
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  const ViewResultPtr result = session->latest();
  EXPECT_TRUE(result->a.error.empty()) << result->a.error;
  EXPECT_EQ(result->a.result.maps.master.size(), cv::Size(64, 48));
  EXPECT_EQ(result->a.smooth.size(), cv::Size(64, 48));
  EXPECT_EQ(result->a.settings.last_level, 2) << "64x48 has room for no more";
  EXPECT_FALSE(result->a.result.attention.fixations.empty());
  EXPECT_FALSE(result->compared);
  EXPECT_GT(woken_, 0);
  EXPECT_EQ(session->state().phase, Phase::open);
  EXPECT_FALSE(session->take_records().empty());
}

TEST_F(SessionTest, ResultsThatAreHeldDoNotChange) {
  const auto session = make();
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  const ViewResultPtr held = session->latest();
  const cv::Mat1f depth = held->frame().depth_mm.clone(), map = held->a.result.maps.master.clone();
  const std::int64_t serial = held->serial;
  ASSERT_TRUE(wait_for([&] { return session->latest() && session->latest()->serial > serial + 8; }));
  EXPECT_EQ(held->serial, serial);
  EXPECT_EQ(cv::norm(held->frame().depth_mm, depth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(held->a.result.maps.master, map, cv::NORM_INF), 0);
}

TEST_F(SessionTest, APausedFrameIsComputedAgainWithTheNewestRequest) {
  const auto session = make();
  session->playback().pause();
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  const std::int64_t index = session->latest()->frame().index;
  ComputeRequest request;
  request.a.workers = 2;
  std::int64_t generation = 0;
  for (int kernel = 3; kernel <= 21; kernel += 2) {
    request.a.kernel = kernel;
    generation = session->set_compute_request(request);
  }
  ASSERT_TRUE(wait_for([&] { return session->latest()->generation == generation; }));
  EXPECT_EQ(session->latest()->frame().index, index);
  EXPECT_EQ(session->latest()->a.settings.kernel, 21);
}

TEST_F(SessionTest, ComparesTwoSettingsOnOneFrame) {
  const auto session = make();
  session->playback().pause();
  session->open({.uri = "ball"});
  ComputeRequest request;
  request.a.kernel = 7;
  request.b = Settings{};
  request.b->model = "centre";
  request.outputs.normals = true;
  session->set_compute_request(request);
  ASSERT_TRUE(wait_for([&] { return session->latest() && session->latest()->compared; }));
  const ViewResultPtr result = session->latest();
  EXPECT_EQ(result->b.settings.model, "centre");
  EXPECT_EQ(result->b.result.frame.depth_mm.data, result->a.result.frame.depth_mm.data);
  EXPECT_GT(cv::norm(result->a.result.maps.master, result->b.result.maps.master), 0);
  EXPECT_EQ(result->a.result.maps.normals.size(), cv::Size(64, 48));
}

TEST_F(SessionTest, AComputationThatFailsIsReportedAndRecovers) {
  const auto session = make();
  session->playback().pause();
  session->open({.uri = "ball"});
  ComputeRequest request;
  request.a.model = "itti";  // there is no colour
  session->set_compute_request(request);
  ASSERT_TRUE(wait_for([&] { return session->latest() && !session->latest()->a.error.empty(); }));
  EXPECT_EQ(session->state().phase, Phase::open) << "it goes on";
  apply_setting(request.a, "levels", "0..9");
  request.a.model = "symmetry3d";
  session->set_compute_request(request);
  ASSERT_TRUE(wait_for([&] { return session->latest()->a.error.find("level") != std::string::npos; }));
  session->set_compute_request({});
  ASSERT_TRUE(wait_for([&] { return session->latest()->a.error.empty(); }));
}

TEST_F(SessionTest, ASourceThatFailsIsReportedAndAnotherCanBeOpened) {
  const auto session = make();
  session->open({.uri = "absent"});
  ASSERT_TRUE(wait_for([&] { return session->state().phase == Phase::ended; }));
  EXPECT_THAT(session->state().error, HasSubstr("no such source"));
  session->open({.uri = "breaks"});
  ASSERT_TRUE(wait_for([&] { return session->state().phase == Phase::ended; }));
  EXPECT_THAT(session->state().error, HasSubstr("the device is gone"));
  EXPECT_EQ(session->state().ledger.in_flight(), 0);
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  EXPECT_EQ(session->state().error, "");
}

TEST_F(SessionTest, SeeksExactly) {
  const auto session = make();
  session->playback().pause();
  session->open({.uri = "ball"});
  for (const std::int64_t index : {17, 3, 29}) {
    ASSERT_TRUE(wait_for([&] { return session->state().phase == Phase::open; }));
    session->playback().seek(index);
    ASSERT_TRUE(wait_for([&] { return session->latest() && session->latest()->frame().index == index; }));
    EXPECT_EQ(session->latest()->frame().depth_mm(0, 0), 1000.0F + static_cast<float>(index));
  }
}

TEST_F(SessionTest, AStartPastTheEndIsReported) {
  const auto session = make();
  session->open({.uri = "ball", .range = {.start = 30}});
  ASSERT_TRUE(wait_for([&] { return session->state().phase == Phase::ended; }));
  EXPECT_THAT(session->state().error, HasSubstr("--start 30 is past the last frame"));
}

TEST_F(SessionTest, AnotherCameraHoldsForTheFrameThatIsShown) {
  const auto session = make();
  session->playback().pause();
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  const Intrinsics own = session->latest()->frame().intrinsics;
  ComputeRequest request;
  request.a = session->latest()->a.settings;
  const cv::Mat1f before = session->latest()->a.result.maps.master.clone();
  request.a.intrinsics = Intrinsics{2 * own.fx, 2 * own.fy, own.cx, own.cy};
  session->set_compute_request(request);
  EXPECT_TRUE(wait_for([&] { return session->latest()->frame().intrinsics.fx == 2 * own.fx; }));
  EXPECT_GT(cv::norm(session->latest()->a.result.maps.master, before), 0) << "the map is computed again";
  session->set_compute_request({});
  EXPECT_TRUE(wait_for([&] { return session->latest()->frame().intrinsics.fx == own.fx; }))
      << "the source's own again";
}

TEST_F(SessionTest, AsFastAsPossibleComputesEveryFrame) {
  const auto session = make();
  session->playback().set_loop(false);
  session->playback().set_speed(0);
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->state().ledger.processed == 30; }));
  EXPECT_EQ(session->state().ledger.dropped, 0);
}

TEST_F(SessionTest, OpeningOverAndOverEndsWithTheNewest) {
  const auto session = make();
  for (int i = 0; i < 20; ++i) session->open({.uri = "ball" + std::to_string(i)});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  EXPECT_EQ(session->state().source.uri, "ball19");
}

}  // namespace
}  // namespace saccade
