// The viewer as a person uses it.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <thread>

#include <opencv2/imgproc.hpp>

#include "core/file.hpp"
#include "core/png.hpp"
#include "output/overlay.hpp"
#include "sources/oni_source.hpp"
#include "tests/support/places.hpp"
#include "tests/ui/support/fake_desktop.hpp"
#include "x_desktop.hpp"
#include "x_program.hpp"

namespace saccade {
namespace {

using Json = nlohmann::json;

const std::string kTable = in_source("recordings/table.oni");

// A value of the result on screen; null while there is none.
Json shown(const Json& j, const char* key) {
  return j.contains("shown") ? j["shown"].value(key, Json()) : Json();
}

class ViewerTest : public XProgramTest {
 protected:
  // The picture's part of a screenshot, without the bars beside it.
  cv::Mat3b picture_of(const cv::Mat3b& shot) const {
    const Json box = now()["places"]["picture"];
    const cv::Rect area(cv::Point(box[0].get<int>(), box[1].get<int>()),
                        cv::Point(box[2].get<int>(), box[3].get<int>()));
    const double scale = std::min(area.width / 640.0, area.height / 480.0);
    const cv::Size size(cvRound(640 * scale), cvRound(480 * scale));
    return shot(cv::Rect(area.x + (area.width - size.width) / 2, area.y + (area.height - size.height) / 2,
                         size.width, size.height) &
                cv::Rect({}, shot.size()));
  }

  // Saves a state for the next start.
  void keep_state(std::string_view json) const {
    std::filesystem::create_directory(folder_ / "saccade");
    write_file(in("saccade/viewer.json"), json);
  }

  void start_sensor(const char* device) {
    ::setenv("SACCADE_VIRTUAL_DEVICE", device, 1);
    start({"openni2"});
    ::unsetenv("SACCADE_VIRTUAL_DEVICE");
  }

  // Whether the log stops growing, however long the machine takes to get there.
  bool draws_nothing() const {
    const auto frames = [this] { return now()["frames"].get<std::int64_t>(); };
    for (int i = 0; i < 60; ++i) {
      const std::int64_t before = frames();
      std::this_thread::sleep_for(std::chrono::seconds(1));
      if (frames() == before) return true;
    }
    return false;
  }

  void type_source(const std::string& uri) const {
    xdotool("key ctrl+o");
    xdotool("sleep 1");
    // ImGui looks at these keys once a frame, and frames are slow here: they are held for a while.
    xdotool("keydown ctrl keydown a sleep 0.5 keyup a keyup ctrl");
    xdotool("type --delay 60 " + uri);
    xdotool("keydown Return sleep 0.5 keyup Return");
  }

  // Records until at least `frames` are written; returns the file, a sound recording.
  std::filesystem::path record_and_check(int frames) const {
    xdotool("key r");
    EXPECT_TRUE(
        until([&](const Json& j) { return j["recording"] == true && j["recorded"]["frames"] >= frames; }));
    xdotool("key r");
    EXPECT_TRUE(until([](const Json& j) { return j["recording"] == false; }));
    const Json recorded = now()["recorded"];
    const std::filesystem::path file = recorded["file"].get<std::string>();
    EXPECT_EQ(file.parent_path(), std::filesystem::canonical(folder_));
    EXPECT_EQ(std::system(
                  (saccade_program() + " oni check '" + file.string() + "' >'" + in("check") + "'").c_str()),
              0);
    OniSource source(file);
    EXPECT_EQ(source.info().frame_count, recorded["frames"].get<std::int64_t>());
    EXPECT_EQ(source.info().size, cv::Size(640, 480));
    Frame frame;
    EXPECT_EQ(source.read(frame, std::chrono::milliseconds(0)).status, ReadStatus::frame);
    EXPECT_GT(cv::countNonZero(frame.depth_mm), 640 * 480 / 4);
    EXPECT_FALSE(frame.colour.empty());
    return file;
  }

  std::filesystem::path take_snapshot() const {
    xdotool("key s");
    EXPECT_TRUE(until([](const Json& j) { return j["snapshot"] != ""; }));
    return now()["snapshot"].get<std::string>();
  }

  // On standard error.
  void expect_one_line_with(const std::string& text) const {
    const auto bytes = read_file(in("err"));
    const std::string err(bytes.begin(), bytes.end());
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_NE(err.find(text), std::string::npos) << err;
  }

  static double likeness(const cv::Mat3b& a, const cv::Mat3b& b) {
    cv::Mat1b grey_a, grey_b;
    cv::cvtColor(a, grey_a, cv::COLOR_BGR2GRAY);
    cv::cvtColor(b, grey_b, cv::COLOR_BGR2GRAY);
    cv::resize(grey_a, grey_a, {160, 120}, 0, 0, cv::INTER_AREA);
    cv::resize(grey_b, grey_b, {160, 120}, 0, 0, cv::INTER_AREA);
    cv::Mat1f result;
    cv::matchTemplate(grey_a, grey_b, result, cv::TM_CCOEFF_NORMED);
    return static_cast<double>(result(0));
  }
};

TEST_F(ViewerTest, TheScreenshotShowsTheFrameAtAnyScale) {
  OniSource source(kTable);
  source.seek(5);
  Frame frame;
  EXPECT_EQ(source.read(frame, std::chrono::milliseconds(0)).status, ReadStatus::frame);
  keep_state(R"({"map": false, "marks": false, "path": false, "outlines": false})");
  for (const char* scale : {"1", "2"}) {
    ASSERT_EQ(run({kTable, "--start", "5", "--frames", "1", "--size", "1280x800", "--ui-scale", scale,
                   "--min-confidence", "0", "--screenshot", in("shot.png")}),
              0);
    const cv::Mat3b shot = decode_png(read_file(in("shot.png")));
    ASSERT_EQ(shot.size(), cv::Size(1280, 800));
    EXPECT_GT(likeness(picture_of(shot), frame.colour), 0.85);
    EXPECT_EQ(now()["shown"]["index"], 5);
    EXPECT_EQ(now()["shown"]["fixations"], 10);
  }
}

// Of this screen, 1920 x 1200; text of twice the size would need more than there is.
TEST_F(ViewerTest, TheFirstWindowIsAsLargeAsItsTextNeeds) {
  for (const auto& [scale, size] :
       {std::pair("1", cv::Size(1280, 800)), std::pair("1.4", cv::Size(1792, 1120)),
        std::pair("2", cv::Size(1920, 1200))}) {
    keep_state("{}");
    ASSERT_EQ(run({kTable, "--frames", "1", "--ui-scale", scale, "--screenshot", in("shot.png")}), 0);
    EXPECT_EQ(decode_png(read_file(in("shot.png"))).size(), size) << scale;
    std::filesystem::remove(in("shot.png"));
  }
}

TEST_F(ViewerTest, PlaysTunesComparesAndQuits) {
  keep_state(R"({"welcome": false})");
  start({"--size", "1280x800"});  // without SOURCE: the bundled recording
  EXPECT_EQ(now()["source"], std::filesystem::canonical(kTable).string());
  EXPECT_TRUE(until([](const Json& j) { return j["position"] > 1; })) << "it plays";
  xdotool("key space");
  ASSERT_TRUE(until([](const Json& j) { return j["paused"] == true; }));

  click("timeline", 0.6);  // of 16 frames: frame 9
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "index") == 9; }));
  xdotool("key Right");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "index") == 10; }));
  xdotool("key Left");
  xdotool("key Left");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "index") == 8; }));

  xdotool("key bracketright");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "kernel") == 17 && shown(j, "index") == 8; }));
  drag("kernel", 0.15, 0.3);
  EXPECT_TRUE(until([](const Json& j) { return j["kernel"] > 30 && shown(j, "kernel") == j["kernel"]; }));
  xdotool("key ctrl+z");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "kernel") == 17; })) << "the drag was one step";
  xdotool("key ctrl+shift+z");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "kernel") > 30; }));
  xdotool("key m");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "model") == "combined"; }));

  xdotool("key c");
  EXPECT_TRUE(until([](const Json& j) { return j["comparison"] == 1 && shown(j, "compared") == true; }));
  xdotool("key c");
  EXPECT_TRUE(until([](const Json& j) { return j["comparison"] == 2 && j["places"].contains("divider"); }));
  drag("picture", 0.5, 0.25);
  EXPECT_TRUE(until([](const Json& j) { return j["divider"] < 0.3; }));
  xdotool("search --onlyvisible --class saccade windowsize 1000 700");
  EXPECT_TRUE(until([](const Json& j) { return j["window"] == Json{1000, 700}; }));

  xdotool("key ctrl+q");
  EXPECT_EQ(wait_for_exit(), 0);
  start({});
  EXPECT_EQ(now()["model"], "combined") << "what was set is there again";
  EXPECT_EQ(now()["comparison"], 2);
}

// By keys; and the files that they leave.
TEST_F(ViewerTest, RecordsAndTakesSnapshots) {
  start({kTable});
  record_and_check(8);
  const std::filesystem::path snapshot = take_snapshot();
  EXPECT_LE(now()["places"]["notice"][2], now()["places"]["splitter"][0]) << "the notice covers no control";
  std::set<std::string> kinds;
  for (const auto& entry : std::filesystem::directory_iterator(snapshot)) {
    const std::string name = entry.path().filename();
    const auto ending = name.find('_');
    kinds.insert(ending == std::string::npos ? name : name.substr(ending));
    if (name.ends_with("overlay.png")) {
      EXPECT_EQ(decode_png(read_file(entry.path())).size(), cv::Size(640, 480));
    }
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"_cloud.ply", "_depth.png", "_fixations.json", "_overlay.png",
                                          "_rgb.png", "_saliency.png", "_saliency.tiff", "meta.json",
                                          "settings.toml", "times.txt"}));
  EXPECT_TRUE(now()["errors"].empty());
}

TEST_F(ViewerTest, RecordsASensorAndPlaysItAgain) {
  start_sensor("synthetic:table?noise=kinect&frames=90");
  const std::filesystem::path file = record_and_check(5);
  type_source(file.string());
  EXPECT_TRUE(until([&](const Json& j) { return j["source"] == file.string() && shown(j, "index") >= 1; }))
      << "the recording is played";
  EXPECT_TRUE(now()["errors"].empty());
}

// Settings of a sensor, their undo, and another mode.
TEST_F(ViewerTest, ASensorIsSetAndSetBack) {
  keep_state(R"({"open": {"tuning": false, "display": false, "sensors": true}})");
  start_sensor("synthetic:table?noise=kinect");
  ASSERT_TRUE(until([](const Json& j) {
    return j.value("mirror", true) == false && j["places"].contains("Mirror") && j["places"].contains("Mode");
  }));
  click("Mirror", 0.2);
  EXPECT_TRUE(until([](const Json& j) { return j["mirror"] == true; }));
  xdotool("key ctrl+z");
  EXPECT_TRUE(until([](const Json& j) { return j["mirror"] == false; })) << "undone at the device too";
  click("Registration", 0.2);
  EXPECT_TRUE(until([](const Json& j) { return j["registration"] == false; }));

  click("Mode", 0.5);
  ASSERT_TRUE(until([](const Json& j) { return j["places"].contains("320x240@30"); }));
  click("320x240@30", 0.5);
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "size") == Json{320, 240}; }));
  EXPECT_TRUE(until([](const Json& j) { return j.value("registration", true) == false; }))
      << "it holds for the next opening";
  EXPECT_TRUE(now()["errors"].empty());
}

TEST_F(ViewerTest, ALostSensorIsTakenUpAgain) {
  start_sensor("synthetic:table?size=160x120&loss_after=20&back_after_ms=3000");
  EXPECT_TRUE(until([](const Json& j) { return j["connection"] == 2 && j["losses"] == 1; })) << "lost";
  EXPECT_TRUE(until([](const Json& j) { return j["connection"] == 0 && shown(j, "index") > 20; })) << "back";
  EXPECT_TRUE(now()["errors"].empty());
}

// A click on the picture pins the probe, a click on a row of the table locks its fixation.
TEST_F(ViewerTest, TheProbeIsPinnedAndAFixationIsFollowed) {
  keep_state(R"({"open": {"tuning": false, "display": false, "fixations": true}})");
  start({kTable, "--paused"});
  ASSERT_TRUE(until([](const Json& j) { return j["places"].contains("fixation 3"); }));
  click("picture", 0.5);
  ASSERT_TRUE(until([](const Json& j) { return j["pinned"].is_array(); }));
  const int column = now()["pinned"][0];
  xdotool("key Right");
  EXPECT_TRUE(until([&](const Json& j) { return j["pinned"][0] == column + 1; }));
  EXPECT_EQ(now()["shown"]["index"], 0) << "the frame stays";
  click("fixation 3", 0.5);
  EXPECT_TRUE(until([](const Json& j) { return j["locked"] == 2; }));
  xdotool("key Escape");
  EXPECT_TRUE(until([](const Json& j) { return j["locked"] == -1 && j["pinned"].is_null(); }));
  xdotool("key Right");
  EXPECT_TRUE(until([](const Json& j) { return shown(j, "index") == 1; }));
}

TEST_F(ViewerTest, TheWelcomeCardOpensASource) {
  start({"--size", "1024x700"});
  ASSERT_TRUE(until([](const Json& j) { return j["places"].contains("welcome open"); }));
  click("welcome open", 0.5);
  ASSERT_TRUE(until([](const Json& j) { return j["places"].contains("open synthetic:cone"); }));
  click("open synthetic:cone", 0.2);
  EXPECT_TRUE(until([](const Json& j) { return j["source"] == "synthetic:cone" && j.contains("shown"); }));
}

TEST_F(ViewerTest, AFileThatIsDroppedIsOpened) {
  start({"synthetic:sphere", "--paused"});
  EXPECT_TRUE(XDesktop(display(), "saccade").drop(kTable));
  EXPECT_TRUE(until([](const Json& j) { return j["source"] == kTable && j.contains("shown"); }));
}

TEST_F(ViewerTest, APathInTheClipboardIsOpened) {
  start({"synthetic:sphere", "--paused"});
  XDesktop desktop(display(), "saccade");
  desktop.copy("file://" + kTable + "\n");
  xdotool("key ctrl+v");
  EXPECT_TRUE(desktop.paste());
  EXPECT_TRUE(until([](const Json& j) { return j["source"] == kTable && j.contains("shown"); }));
}

TEST_F(ViewerTest, TheDesktopsFileDialogOpensASource) {
  if (!is_installed("dbus-daemon")) GTEST_SKIP() << "dbus-daemon is not installed";
  FakeDesktop desktop;
  ASSERT_TRUE(desktop.start(folder_));
  desktop.answer(FakeDesktop::End::chosen, "file://" + kTable);
  ::setenv("DBUS_SESSION_BUS_ADDRESS", desktop.address().c_str(), 1);
  start({"synthetic:sphere", "--paused"});
  xdotool("key ctrl+o");
  ASSERT_TRUE(until([](const Json& j) { return j["places"].contains("choose a file"); }));
  click("choose a file", 0.5);
  EXPECT_TRUE(until([](const Json& j) { return j["source"] == kTable && j.contains("shown"); }));
  const auto shown = desktop.shown();
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].parent.substr(0, 4), "x11:");
  EXPECT_EQ(shown[0].folder, std::filesystem::canonical(folder_).string());
  xdotool("key space");
  EXPECT_TRUE(until([](const Json& j) { return j["paused"] == false; })) << "the own dialog is closed";
}

TEST_F(ViewerTest, MinimisedItComputesButDoesNotDraw) {
  start({kTable});
  XDesktop desktop(display(), "saccade");
  desktop.minimise();
  EXPECT_TRUE(draws_nothing());
  const std::int64_t processed = now()["processed"];
  desktop.restore();
  EXPECT_TRUE(until([&](const Json& j) { return j["processed"] > processed + 1; })) << "it went on";
}

TEST_F(ViewerTest, AMistypedSourceIsReportedAndThePresentOneGoesOn) {
  start({kTable});
  xdotool("key r");
  ASSERT_TRUE(until([](const Json& j) { return j["recording"] == true && j["recorded"]["frames"] > 1; }));
  type_source("/no/such.oni");
  ASSERT_TRUE(until([](const Json& j) { return j["errors"].size() == 1; }));
  EXPECT_NE(now()["errors"][0].get<std::string>().find("/no/such.oni"), std::string::npos);
  const Json then = now();
  EXPECT_EQ(then["source"], kTable);
  EXPECT_TRUE(until([&](const Json& j) {
    return j["recording"] == true && j["recorded"]["frames"] > then["recorded"]["frames"].get<int>() + 1;
  })) << "it is still played and recorded";
  type_source("synthetic:sphere");
  EXPECT_TRUE(until([](const Json& j) { return j["errors"].empty() && j.contains("shown"); }));
}

TEST_F(ViewerTest, ShowsADraftOfWhatTakesLongAndGoesOnDrawing) {
  start({kTable, "--paused", "--kernel", "61"});
  const auto whole = [](int kernel) {
    return [kernel](const Json& j) { return shown(j, "kernel") == kernel && shown(j, "draft") == false; };
  };
  ASSERT_TRUE(until(whole(61)));
  xdotool("key bracketleft");
  ASSERT_TRUE(until(whole(59)));
  const std::int64_t generation = now()["generation"];
  int with_draft = 0;
  for (const Json& j : lines())
    if (j["generation"] == generation && shown(j, "generation") == generation && shown(j, "draft") == true)
      ++with_draft;
  EXPECT_GE(with_draft, 3) << "frames of the window between the draft and the whole";
}

TEST_F(ViewerTest, IdleItDrawsNothing) {
  start({kTable, "--paused"});
  EXPECT_TRUE(draws_nothing());
}

TEST_F(ViewerTest, WithoutADisplayItSaysSoInOneLine) {
  EXPECT_EQ(run({kTable}, false), 1);
  expect_one_line_with("no display");
}

// As `run` with the same inputs.
TEST_F(ViewerTest, AScreenshotOfWhatCannotBeReadEndsWithItsStatus) {
  const auto screenshot = [&](const std::string& source) {
    return run({source, "--screenshot", in("shot.png")});
  };
  EXPECT_EQ(screenshot(in("absent.oni")), 3);
  expect_one_line_with("no screenshot: no such source");
  EXPECT_EQ(screenshot("synthetic:nowhere"), 2);
  std::filesystem::create_directory(in("damaged"));
  auto png = encode_png(cv::Mat1w(120, 160, std::uint16_t{1000}));
  png.resize(60);
  write_file(in("damaged/0_depth.png"), png);
  EXPECT_EQ(screenshot(in("damaged")), 3) << "every frame is rejected";
  expect_one_line_with("not a valid PNG");
  EXPECT_FALSE(std::filesystem::exists(in("shot.png")));
}

}  // namespace
}  // namespace saccade
