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

 protected:
  SourceInfo info_;

 private:
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
  EXPECT_FALSE(session->poll().records.empty());
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
  ASSERT_TRUE(wait_for([&] { return session->state().failed == 1; }));
  EXPECT_THAT(session->state().failure, HasSubstr("no such source"));
  EXPECT_EQ(session->state().failure_status, ExitStatus::unreadable);
  EXPECT_EQ(session->state().phase, Phase::idle);
  EXPECT_EQ(session->state().opening, "");
  session->open({.uri = "breaks"});
  ASSERT_TRUE(wait_for([&] { return session->state().phase == Phase::ended; }));
  EXPECT_THAT(session->state().error, HasSubstr("the device is gone"));
  EXPECT_EQ(session->state().error_status, ExitStatus::failed);
  EXPECT_EQ(session->state().ledger.in_flight(), 0);
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->state().opened == 2; }));
  EXPECT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  EXPECT_EQ(session->state().error, "");
}

TEST_F(SessionTest, ASourceGoesOnUntilAnotherIsOpenAndAfterAFailure) {
  const auto session = make();
  session->open({.uri = "ball"});
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  std::atomic<int> tapped = 0;
  session->playback().set_tap([&](const Frame&) { ++tapped; });
  session->open({.uri = "absent"});
  ASSERT_TRUE(wait_for([&] { return session->state().failed == 1; }));
  const SessionState after = session->state();
  EXPECT_EQ(after.phase, Phase::open);
  EXPECT_EQ(after.uri, "ball");
  EXPECT_EQ(after.opened, 1);
  EXPECT_NE(session->latest(), nullptr);
  const int before = tapped;
  EXPECT_TRUE(wait_for([&] { return tapped > before + 5; })) << "it is still recorded";

  session->open({.uri = "other"});
  ASSERT_TRUE(wait_for([&] { return session->state().opened == 2; }));
  EXPECT_EQ(session->state().uri, "other");
  const int ended = tapped;
  ASSERT_TRUE(wait_for([&] { return session->latest() != nullptr; }));
  EXPECT_EQ(tapped, ended) << "a recording holds one source";
}

// "sensor" can be open once at a time; "sensor:gone" is not connected.
class SensorSource : public BallSource {
 public:
  SensorSource(const std::string& uri, std::atomic<int>& open) : BallSource(uri), open_(open) {
    if (open_++ > 0) ADD_FAILURE() << uri << " is opened while it is in use";
    info_.kind = "sensor";
    info_.live = true;
    info_.frame_count.reset();
  }
  ~SensorSource() override { --open_; }
  SensorSource(const SensorSource&) = delete;
  SensorSource& operator=(const SensorSource&) = delete;
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override {
    seek(0);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return BallSource::read(frame, timeout);
  }
  SourceState state() const override {
    SourceState state;
    if (info_.uri == "sensor:gone") state.connection = SourceState::Connection::waiting;
    return state;
  }

 private:
  std::atomic<int>& open_;
};

TEST_F(SessionTest, ASensorIsClosedBeforeItIsOpenedAgainAndComesBackAfterAFailure) {
  std::atomic<int> open = 0;
  Session session(
      [&](const std::string& uri, auto&&...) -> std::unique_ptr<FrameSource> {
        return std::make_unique<SensorSource>(uri, open);
      },
      [] {}, ComputeRequest{});
  session.open({.uri = "sensor"});
  ASSERT_TRUE(wait_for([&] { return session.latest() != nullptr; }));
  session.open({.uri = "sensor"});
  ASSERT_TRUE(wait_for([&] { return session.state().opened == 2; }));
  session.open({.uri = "sensor:gone"});
  ASSERT_TRUE(wait_for([&] { return session.state().failed == 1; }));
  EXPECT_THAT(session.state().failure, HasSubstr("not connected"));
  EXPECT_EQ(session.state().phase, Phase::open);
  EXPECT_EQ(session.state().uri, "sensor");
  EXPECT_TRUE(wait_for([&] { return session.latest() != nullptr; })) << "it is open again";
}

TEST_F(SessionTest, TheStrengthOfAFrameIsTheLargestSaliencyOfItsMap) {
  const auto session = make();
  session->playback().pause();
  session->open({.uri = "ball"});
  SessionUpdate update;
  ASSERT_TRUE(wait_for([&] {
    update = session->poll();
    return !update.records.empty();
  }));
  const cv::Mat1f& map = update.latest->a.result.maps.master;
  const float largest = *std::max_element(map.begin(), map.end());
  EXPECT_GT(largest, 0);
  EXPECT_EQ(update.records[0].strength, largest);
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
  ASSERT_TRUE(wait_for([&] { return session->state().failed == 1; }));
  EXPECT_THAT(session->state().failure, HasSubstr("--start 30 is past the last frame"));
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
