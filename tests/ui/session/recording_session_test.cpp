#include "ui/session/recording_session.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "sources/oni_source.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

class RecordingSessionTest : public FolderTest {
 protected:
  static Frame frame_at(std::int64_t us, float depth_mm) {
    Frame frame;
    frame.timestamp_us = us;
    frame.depth_mm = cv::Mat1f(48, 64, depth_mm);
    frame.intrinsics = Intrinsics::guess_for({64, 48});
    return frame;
  }

  RecordingStatus closed() {
    session_.stop();
    RecordingStatus status = session_.status();
    for (; status.phase != RecordingStatus::Phase::idle; status = session_.status())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return status;
  }

  RecordingSession session_;
};

TEST_F(RecordingSessionTest, WritesFramesOfferedBetweenStartAndStop) {
  const auto file = folder_ / "a.oni";
  EXPECT_EQ(session_.status().phase, RecordingStatus::Phase::idle);
  session_.offer(frame_at(0, 500));  // nobody records yet
  session_.start(file, {});
  EXPECT_EQ(session_.status().phase, RecordingStatus::Phase::recording);
  EXPECT_THROW(session_.start(folder_ / "b.oni", {}), std::logic_error);
  for (int i = 1; i <= 5; ++i) session_.offer(frame_at(i * 40'000, 1000.0F + static_cast<float>(i)));
  const RecordingStatus status = closed();
  EXPECT_EQ(status.frames, 5U);
  EXPECT_EQ(status.dropped, 0U);
  EXPECT_EQ(status.bytes, std::filesystem::file_size(file));
  EXPECT_EQ(status.error, "");
  EXPECT_EQ(status.file, file);
  session_.offer(frame_at(0, 500));

  OniSource source(file.string());
  Frame frame;
  for (int i = 1; i <= 5; ++i) {
    ASSERT_EQ(source.read(frame, {}).status, ReadStatus::frame);
    EXPECT_EQ(frame.depth_mm(10, 10), 1000 + i);
    EXPECT_EQ(frame.timestamp_us, (i - 1) * 40'000);
  }
  EXPECT_EQ(source.read(frame, {}).status, ReadStatus::end);
}

TEST_F(RecordingSessionTest, TimeGoesOnAfterASeekBack) {
  session_.start(folder_ / "a.oni", {});
  for (const std::int64_t us : {100'000, 140'000, 20'000, 60'000}) session_.offer(frame_at(us, 900));
  EXPECT_EQ(closed().frames, 4U);
  OniSource source((folder_ / "a.oni").string());
  Frame frame;
  std::vector<std::int64_t> times;
  while (source.read(frame, {}).status == ReadStatus::frame) times.push_back(frame.timestamp_us);
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 40'000, 73'333, 113'333}));
}

TEST_F(RecordingSessionTest, AnErrorEndsTheRecordingAndIsReported) {
  session_.start(folder_ / "a.oni", {});
  session_.offer(frame_at(0, 900));
  Frame other = frame_at(40'000, 900);
  other.depth_mm = cv::Mat1f(24, 32, 900.0F);  // a size that the file cannot hold
  session_.offer(other);
  const RecordingStatus status = closed();
  EXPECT_NE(status.error, "");
  EXPECT_EQ(status.frames, 1U);
  session_.start(folder_ / "b.oni", {});
  EXPECT_EQ(session_.status().error, "") << "a new recording, a new start";
}

TEST_F(RecordingSessionTest, AFileThatExistsIsRefused) {
  session_.start(folder_ / "a.oni", {});
  session_.offer(frame_at(0, 900));
  closed();
  EXPECT_THROW(session_.start(folder_ / "a.oni", {}), Error);
  EXPECT_EQ(session_.status().phase, RecordingStatus::Phase::idle);
}

TEST_F(RecordingSessionTest, TheDestructorClosesTheFile) {
  {
    RecordingSession session;
    session.start(folder_ / "a.oni", {});
    session.offer(frame_at(0, 900));
  }
  OniSource source((folder_ / "a.oni").string());
  EXPECT_EQ(source.info().frame_count, 1);
}

}  // namespace
}  // namespace saccade
