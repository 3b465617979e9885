#include "ui/panels/sensor_drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/ui/support/imgui_frames.hpp"

namespace saccade {
namespace {

using namespace std::chrono_literals;
using Connection = SourceState::Connection;
using testing::HasSubstr;

SourceFacts live(double rate_hz) {
  return {.open = true, .uri = "openni2", .live = true, .rate_hz = rate_hz};
}

TEST(Headline, SaysHowTheSourceDoes) {
  const std::chrono::steady_clock::time_point now{100s};
  EXPECT_EQ(headline(live(30), now).text, "Live 30.0 fps");
  EXPECT_EQ(headline(live(30), now).tone, Tone::good);
  EXPECT_EQ(headline(live(0), now).text, "Live, no frames");

  SourceFacts source = live(0);
  source.connection.connection = Connection::waiting;
  EXPECT_EQ(headline(source, now).text, "Waiting for the sensor");
  source.connection.connection = Connection::lost;
  source.connection.since = now - 3500ms;
  EXPECT_EQ(headline(source, now).text, "Sensor lost 3 s ago, retrying");
  source.connection.since = now - 75s;
  EXPECT_EQ(headline(source, now).text, "Sensor lost 1 min 15 s ago, retrying");
  source.error = "the device is of another size";
  EXPECT_EQ(headline(source, now).tone, Tone::bad);

  EXPECT_EQ(headline({.open = true, .uri = "a.oni", .rate_hz = 4}, now).text, "Playing 4.0 fps");
  EXPECT_EQ(headline({.open = true, .uri = "a.oni", .paused = true}, now).text, "Paused");
  EXPECT_EQ(headline({.opening = true}, now).text, "Opening …");
  EXPECT_EQ(headline({}, now).text, "No source");
}

TEST(RecordingLine, ShowsTimeSizeAndDrops) {
  EXPECT_EQ(recording_line({}).text, "");
  RecordingStatus recording{.phase = RecordingStatus::Phase::recording,
                            .file = "a.oni",
                            .seconds = 61.5,
                            .frames = 1800,
                            .bytes = 123'400'000,
                            .error = ""};
  EXPECT_EQ(recording_line(recording).text, "Recording: 1 min 01 s, 1800 frames, 123.4 MB, 0 dropped");
  EXPECT_EQ(recording_line(recording).tone, Tone::good);
  recording.dropped = 2;
  EXPECT_EQ(recording_line(recording).tone, Tone::warning);
  recording.phase = RecordingStatus::Phase::idle;
  EXPECT_THAT(recording_line(recording).text, HasSubstr("Recorded: "));
  recording.error = "the disk is full";
  EXPECT_THAT(recording_line(recording).text, HasSubstr("Ended early: "));
}

class SensorPanelTest : public ::testing::Test {
 protected:
  test::ImGuiFrames::Drawn draw() {
    return frames_.frame([this] { draw_inside(); });
  }

  // Clicks at places all over the panel, so that each thing in it is clicked, wherever it stands.
  void click_everywhere() {
    for (float y = 4; y < 400; y += 10)
      for (float x = 10; x < 330; x += 40) frames_.click({x, y}, [this] { draw_inside(); });
  }
  void draw_inside() {
    const SensorActions actions = draw_sensors(facts_, {});
    if (actions.open) opened_ = *actions.open;
    if (actions.request) request_ = *actions.request;
    toggles_ += actions.toggle_recording ? 1 : 0;
    snapshots_ += actions.snapshot ? 1 : 0;
  }

  test::ImGuiFrames frames_{340, 500};
  SensorFacts facts_;
  std::string opened_;
  SensorValues request_;
  int toggles_ = 0, snapshots_ = 0;
};

TEST_F(SensorPanelTest, ButtonsAskForWhatTheySay) {
  facts_.source = live(30);
  facts_.source.uri = "openni2:another/0";
  facts_.devices = {{"Virtual", "openni2:virtual/0", "Saccade"}};
  facts_.values.mirror = false;
  click_everywhere();
  EXPECT_EQ(opened_, "openni2:virtual/0");
  EXPECT_EQ(request_.mirror, true);
  EXPECT_FALSE(request_.registration.has_value()) << "only what was changed";
  EXPECT_GT(toggles_, 0);
  EXPECT_GT(snapshots_, 0);
}

TEST_F(SensorPanelTest, NothingToRecordAndNothingToOpenTwice) {
  facts_.source = {};
  facts_.devices.emplace();
  click_everywhere();
  EXPECT_EQ(toggles_ + snapshots_, 0) << "no source is open";

  facts_.source = live(30);
  facts_.source.uri = "openni2:virtual/0";
  facts_.devices = {{"Virtual", "openni2:virtual/0", ""}};
  click_everywhere();
  EXPECT_EQ(opened_, "");
}

TEST_F(SensorPanelTest, LongTextsAreWrapped) {
  facts_.source = live(30);
  facts_.source.connection.text = std::string(30, 'w') + " " + std::string(30, 'w');
  facts_.source.connection.losses = 2;
  facts_.source.connection.colourless = 3;
  facts_.source.connection.notes = {"exposure was set to 40, but the device says 33 and does not change it"};
  facts_.recording.file = "a.oni";
  facts_.recording.error = "cannot write: No space left on device: a.oni (free some space on this disk)";
  facts_.folder = "/home/somebody/a folder/with a long name";
  facts_.snapshot = "snapshot in /home/somebody/a folder/with a long name/snapshot-20260101-120000";
  facts_.devices_error = "cannot start OpenNI2: no drivers (reinstall the package libopenni2-0)";
  draw();
  const auto drawn = draw();
  EXPECT_LE(drawn.content_width, drawn.window_width + 1);
}

}  // namespace
}  // namespace saccade
