// The viewer's own panels, drawn without a display: what they show and what a click in them does.
#include <cmath>

#include <gmock/gmock.h>

#include "panel_test.hpp"
#include "ui/panels/open_dialog.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/picture_clicks.hpp"
#include "ui/panels/picture_drawing.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

using ::testing::Contains;

TEST_F(ViewerPanelsTest, TheKernelIsSetByItsSliderAndIsOdd) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  click("kernel", draw, 0.5F);
  EXPECT_NEAR(state_.settings.a.kernel, 65, 8);
  EXPECT_EQ(state_.settings.a.kernel % 2, 1);
  EXPECT_EQ(state_.settings.b.kernel, Settings{}.kernel);
}

TEST_F(ViewerPanelsTest, TuningEditsTheSideThatIsChosen) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  state_.comparison = Comparison::split;
  state_.edit_b = true;
  click("kernel", draw, 0.5F);
  EXPECT_GT(state_.settings.b.kernel, 50);
  EXPECT_EQ(state_.settings.a.kernel, Settings{}.kernel);
}

TEST_F(ViewerPanelsTest, TheLeastConfidenceIsSetByItsSliderForProtoOnly) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  click("confidence", draw, 0.75F);
  const double least = state_.settings.a.min_confidence;
  EXPECT_NEAR(least, 0.75, 0.1);
  EXPECT_EQ(least, std::round(100 * least) / 100);
  state_.settings.a.selector = Selector::wta;
  view_.places.clear();
  settled(draw);
  EXPECT_FALSE(view_.places.contains("confidence"));
}

TEST_F(ViewerPanelsTest, DwellIsSetForASequenceAndNotForStills) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  show_result();
  click("dwell", draw, 0.9F);
  EXPECT_EQ(state_.settings.a.dwell_s, Settings{}.dwell_s);
  state_.settings.a.tracking = Tracking::on;
  click("dwell", draw, 0.9F);
  EXPECT_GT(state_.settings.a.dwell_s, 2);
  state_.settings.a = Settings{};
  view_.source.source.sequence = true;
  click("dwell", draw, 0.9F);
  EXPECT_GT(state_.settings.a.dwell_s, 2);
}

TEST_F(ViewerPanelsTest, AModelOfTheImageHasNoKernel) {
  state_.settings.a.model = "itti";
  click(
      "kernel", [this] { draw_tuning_panel(view_); }, 0.5F);
  EXPECT_EQ(state_.settings.a.kernel, Settings{}.kernel);
}

TEST_F(ViewerPanelsTest, UndoIsOfferedOnlyWhereThereIsSomething) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  click("undo", draw);
  click("redo", draw);
  EXPECT_THAT(acts_, ::testing::IsEmpty());
  view_.can_undo = view_.can_redo = true;
  click("undo", draw);
  click("redo", draw);
  click("copy", draw);
  EXPECT_THAT(acts_, ::testing::ElementsAre(Action::undo, Action::redo, Action::copy_command));
}

TEST_F(ViewerPanelsTest, TheSidePanelsFitIntoTheSideBar) {
  show_result();
  state_.comparison = Comparison::split;
  state_.settings.a.selector = Selector::wta;
  state_.style.background = Background::depth;
  state_.style.depth.range_mm = ValueRange{500, 12345};
  state_.style.map.range = ValueRange{0, 4};
  expect_fits([this] { draw_tuning_panel(view_); });
  expect_fits([this] { draw_display_panel(view_); });
  expect_fits([this] { draw_performance_panel(view_); });
}

TEST_F(ViewerPanelsTest, ALockedRangeBeginsWithTheValuesOfTheLegend) {
  show_result();
  auto result = std::make_shared<ViewResult>(*view_.result);
  result->a.marks.emplace().range_high = 0.75F;  // over time; the map's own is .25
  view_.result = result;
  click(
      "lock map", [this] { draw_display_panel(view_); }, 0.1F);
  EXPECT_EQ(state_.style.map.range, (ValueRange{0, 0.75F}));
}

class TransportTest : public ViewerPanelsTest {
 protected:
  TransportTest() : ViewerPanelsTest(900, 120) {}
  const Draw draw_ = [this] { draw_transport(view_); };
};

TEST_F(TransportTest, ButtonsDoWhatTheyShow) {
  show_result();
  for (const char* button : {"first", "back", "play", "on", "last", "loop", "record", "snapshot"})
    click(button, draw_);
  EXPECT_THAT(acts_, ::testing::ElementsAre(Action::first_frame, Action::previous_frame, Action::play_pause,
                                            Action::next_frame, Action::last_frame, Action::toggle_loop,
                                            Action::record, Action::snapshot));
  expect_fits(draw_);
}

TEST_F(TransportTest, ALiveSourceCannotBeStepped) {
  show_result();
  view_.source.source.live = true;
  settled(draw_);
  EXPECT_TRUE(view_.places.contains("play"));
  for (const char* button : {"first", "back", "on", "last", "loop", "timeline"})
    EXPECT_FALSE(view_.places.contains(button)) << button;
}

TEST_F(TransportTest, WithNothingOpenNothingCanBePressed) {
  show_result();
  view_.source.phase = SessionState::Phase::ended;
  for (const char* button : {"play", "record"}) click(button, draw_);
  EXPECT_THAT(acts_, ::testing::IsEmpty());
}

TEST_F(TransportTest, TheTimeLineShowsTheStrengthsAndThePresentFrame) {
  show_result();
  view_.timeline.add(3, 2, true);
  view_.timeline.add(4, 1, true);
  settled(draw_);
  ImVec2 low, high;
  ASSERT_TRUE(ImGuiFrames::box_of(view_.colours->plot, low, high));
  const auto [left, top, right, bottom] = view_.places.at("timeline");
  const float frame = (right - left) / 16;
  EXPECT_NEAR(low.x, left + 3 * frame, 2);
  EXPECT_NEAR(high.x, left + 5 * frame, 2);
  EXPECT_NEAR(low.y, top, 1) << "the strongest reaches to the top";
  EXPECT_NEAR(high.y, bottom, 1);
  ASSERT_TRUE(ImGuiFrames::box_of(view_.colours->accent, low, high));
}

TEST_F(TransportTest, TheWheelZoomsTheTimeLineAndTheRightButtonMarksAPart) {
  show_result();
  for (std::int64_t i = 0; i < 16; ++i) view_.timeline.add(i, 1, true);
  settled(draw_);
  const auto [left, top, right, bottom] = view_.places.at("timeline");
  ImGuiIO& io = ImGui::GetIO();
  const ImVec2 at{left + (right - left) / 4, (top + bottom) / 2};
  io.MousePos = at;
  settled(draw_);
  io.MouseWheel = 2;
  frames_.frame(draw_);
  const VisibleFrames visible = view_.timeline_zoom.visible(16);
  EXPECT_LT(visible.count, 12);
  EXPECT_NEAR(visible.first + visible.count / 4, 4, 0.01) << "the place under the mouse stays";

  view_.timeline_zoom.reset();
  io.MouseDown[ImGuiMouseButton_Right] = true;
  settled(draw_);
  io.MousePos.x = left + (right - left) * 0.72F;
  settled(draw_);
  io.MouseDown[ImGuiMouseButton_Right] = false;
  settled(draw_);
  EXPECT_EQ(session_.playback().state().in, 4);
  EXPECT_EQ(session_.playback().state().out, 11);
  io.MouseDown[ImGuiMouseButton_Right] = true;
  settled(draw_);
  io.MouseDown[ImGuiMouseButton_Right] = false;
  settled(draw_);
  EXPECT_FALSE(session_.playback().state().in || session_.playback().state().out);
}

class WideTest : public ViewerPanelsTest {
 protected:
  WideTest() : ViewerPanelsTest(1280, 800) {}
};

TEST_F(WideTest, AnErrorStaysUntilItIsDismissed) {
  view_.errors = {"cannot read: a.oni (is it there?)",
                  "cannot write: the disk is full: " + std::string(300, 'x')};
  view_.notes = {"a gap of 3 frames"};
  const Draw draw = [this] { draw_messages(view_); };
  expect_fits(draw);
  ImVec2 low, high;
  EXPECT_TRUE(ImGuiFrames::box_of(view_.colours->error, low, high));
  EXPECT_TRUE(ImGuiFrames::box_of(view_.colours->warning, low, high));
  click("dismiss error", draw);
  click("dismiss notes", draw);
  EXPECT_EQ(view_.errors.size(), 1u);
  EXPECT_TRUE(view_.notes.empty());
}

TEST_F(WideTest, OfManyErrorsOnlyTheNewestHaveRoom) {
  for (int i = 0; i < 7; ++i) view_.report(std::string(3, static_cast<char>('a' + i)));
  view_.report("ggg");
  EXPECT_EQ(view_.errors.size(), 7u) << "the last one is there already";
  view_.report("cannot read: /" + std::string(3000, 'x') + ".oni (check the path)");
  EXPECT_LE(view_.errors.back().size(), 400u);
  EXPECT_TRUE(view_.errors.back().starts_with("cannot read: /x") &&
              view_.errors.back().ends_with("x.oni (check the path)"));
  const Draw draw = [this] { draw_messages(view_); };
  expect_fits(draw);
  ImVec2 low, high;
  ASSERT_TRUE(ImGuiFrames::box_of(view_.colours->error, low, high));
  EXPECT_LT(high.y, 200);
  click("dismiss all errors", draw);
  EXPECT_TRUE(view_.errors.empty());
}

TEST_F(WideTest, ALongTextIsShortenedBetweenCharacters) {
  EXPECT_EQ(shortened("abcdefghij", 10), "abcdefghij");
  EXPECT_EQ(shortened("abcdefghijk", 9), "abc…ijk");
  EXPECT_EQ(shortened("äöüäöüäöü", 13), "äö…öü");
}

TEST_F(WideTest, WhereTheDesktopHasFileDialogsTheyAreOffered) {
  std::vector<FileDialog> shown;
  std::function<void(const std::string&)> choose;
  OpenDialog dialog([] {});
  const Draw draw = [&] { dialog.draw(view_); };
  dialog.show();
  settled(draw);
  EXPECT_FALSE(view_.places.contains("choose a file"));
  view_.file_dialog = [&](const FileDialog& asked, auto chosen) {
    shown.push_back(asked);
    choose = std::move(chosen);
  };
  click("choose a file", draw);
  click("choose a folder", draw);
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].kind, FileDialog::Kind::open_file);
  EXPECT_EQ(shown[1].kind, FileDialog::Kind::open_folder);
  choose("/data/tum");
  EXPECT_EQ(opened_, "/data/tum");
  settled(draw);
  EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0) << "it closes";
}

TEST_F(WideTest, ARecordingAndANewSensorAreOffered) {
  view_.recorded = "/tmp/a.oni";
  view_.connected = {{"Xtion", "openni2:1", ""}};
  const Draw draw = [this] { draw_messages(view_); };
  click("play recorded", draw);
  EXPECT_EQ(opened_, "/tmp/a.oni");
  click("open connected", draw);
  EXPECT_EQ(opened_, "openni2:1");
  click("dismiss recorded", draw);
  click("dismiss connected", draw);
  EXPECT_TRUE(view_.recorded.empty() && view_.connected.empty());
}

TEST_F(WideTest, ASourceThatEndedWithAnErrorCanBeTriedAgain) {
  view_.source.phase = SessionState::Phase::ended;
  view_.source.uri = "a.oni";
  view_.errors = {"the disk is gone"};
  click("try again", [this] { draw_messages(view_); });
  EXPECT_EQ(opened_, "a.oni");
}

TEST_F(WideTest, WhileASensorIsWaitedForThereIsARetry) {
  view_.source.phase = SessionState::Phase::open;
  view_.source.uri = "openni2";
  view_.source.source.live = true;
  view_.source.connection.connection = SourceState::Connection::waiting;
  view_.advice = {"no USB device looks like a sensor: plug one in"};
  click("retry", [this] { draw_state_banner(view_, {0, 0}, {1280, 800}); });
  EXPECT_EQ(opened_, "openni2");
}

TEST_F(WideTest, TheOpenDialogOffersSensorsExamplesAndScenes) {
  view_.sensors.devices = {{"Xtion", "openni2:1", "PS1080"}};
  view_.example = "/data/table.oni";
  state_.recent = {"/a/very/long/path/to/a/recording.oni"};
  OpenDialog dialog([] {});
  const Draw draw = [&] { dialog.draw(view_); };
  for (const auto& [place, uri] : {std::pair("open Xtion", "openni2:1"),
                                   {"open table.oni", "/data/table.oni"},
                                   {"open recording.oni", "/a/very/long/path/to/a/recording.oni"},
                                   {"open synthetic:room", "synthetic:room"}}) {
    dialog.show();
    click(place, draw);
    EXPECT_EQ(opened_, uri);
    settled(draw);
    EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0) << "it closes";
  }
}

TEST_F(WideTest, TheFormsOfSourcesAreNotBroken) {
  std::string text;
  settled([&] { text = forms_text("openni2[:URI], FOLDER, FILE.oni, FILE.bag", 140); });
  EXPECT_EQ(text, "A path, or:\nopenni2[:URI],\nFOLDER, FILE.oni,\nFILE.bag");
}

TEST_F(WideTest, TheFontsHaveTheCharactersOfTheTexts) {
  const Fonts fonts = load_fonts(1);
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ASSERT_TRUE(atlas.Build());
  if (fonts.bold == atlas.Fonts[0]) GTEST_SKIP() << "no font of the system";
  const auto has = [](ImFont* font, std::u16string_view characters) {
    for (const char16_t c : characters)
      EXPECT_NE(font->FindGlyphNoFallback(c), nullptr) << static_cast<int>(c);
  };
  for (ImFont* font : {atlas.Fonts[0], fonts.bold}) has(font, u"Az09~\u00c9\u0161\u00d7\u2013\u2026\u2212");
  has(fonts.large, u"Az09~\u2026");
}

TEST_F(WideTest, TheNameOfTheSourceIsSeenBeforeItsState) {
  const Draw draw = [this] { draw_top_bar(view_); };
  show_result();
  view_.source.uri = "/recordings/of_a_kitchen.oni";
  const auto width_of = [&](const char* place) {
    const auto [left, top, right, bottom] = view_.places.at(place);
    return right - left;
  };
  settled(draw);
  const float whole = ImGui::CalcTextSize("of_a_kitchen.oni").x;
  EXPECT_NEAR(width_of("source"), whole, 1);
  EXPECT_TRUE(view_.places.contains("state"));
  view_.places.clear();
  ImGui::GetIO().DisplaySize = {640, 400};
  settled(draw);
  EXPECT_FALSE(view_.places.contains("state"));
  EXPECT_GT(width_of("source"), 40);
}

TEST_F(WideTest, ADropDownListCanBeClosed) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  click("model", draw);
  settled(draw);
  const auto lists = [] { return ImGui::GetCurrentContext()->OpenPopupStack.Size; };
  ASSERT_EQ(lists(), 1);
  frames_.frame([&] {
    close_top_popup();
    draw();
  });
  settled(draw);
  EXPECT_EQ(lists(), 0);
}

TEST_F(WideTest, TheHelpShowsEveryShortcutAndFits) {
  HelpDialog help;
  const Draw draw = [&] { help.draw(view_); };
  help.toggle();
  settled(draw);
  EXPECT_TRUE(help.is_open());
  const ImGuiWindow* window = ImGui::FindWindowByName("Help");
  ASSERT_NE(window, nullptr);
  EXPECT_LE(window->ContentSize.x, window->Size.x);
  EXPECT_LE(window->ContentSize.y, window->Size.y);
  EXPECT_LE(window->Size.y, 800 * 0.94F);
  help.toggle();
  settled(draw);
  EXPECT_FALSE(help.is_open());
}

// 1280 x 800 at scale 2.
class NarrowTest : public ViewerPanelsTest {
 protected:
  NarrowTest() : ViewerPanelsTest(640, 400) {}
};

TEST_F(NarrowTest, TheKeysOfTheHelpFit) {
  HelpDialog help;
  help.toggle();
  const Draw draw = [&] { help.draw(view_); };
  settled(draw);
  settled(draw);
  const ImGuiTable* keys = nullptr;
  for (int i = 0; i < ImGui::GetCurrentContext()->Tables.GetMapSize(); ++i)
    if (const ImGuiTable* table = ImGui::GetCurrentContext()->Tables.TryGetMapData(i)) keys = table;
  ASSERT_NE(keys, nullptr);
  for (int i = 0; i < keys->ColumnsCount; ++i)
    EXPECT_LE(keys->Columns[i].ContentMaxXUnfrozen, keys->Columns[i].WorkMaxX) << i;
}

TEST_F(NarrowTest, TheWelcomeCardHoldsItsButtons) {
  view_.welcome = true;
  settled([this] { draw_welcome(view_, {0, 0}, {300, 400}); });
  const float right = 300 - view_.px(12);
  EXPECT_LE(view_.places.at("welcome open")[2], right);
  EXPECT_LE(view_.places.at("welcome help")[2], right);
}

TEST_F(WideTest, TheStateIsShownInTheMiddleOnlyWhileSomethingIsWrong) {
  const Draw draw = [this] { draw_state_banner(view_, {0, 0}, {1280, 800}); };
  ImVec2 low, high;
  const auto shown = [&](Tone tone) {
    settled(draw);
    return ImGuiFrames::box_of(ImGui::GetColorU32(tone_colour(tone)), low, high);
  };
  EXPECT_TRUE(shown(Tone::quiet)) << "nothing is open";
  view_.source.phase = SessionState::Phase::open;
  view_.source.uri = "openni2";
  view_.source.source.live = true;
  view_.source.connection.connection = SourceState::Connection::waiting;
  EXPECT_TRUE(shown(Tone::warning));
  EXPECT_NEAR((low.x + high.x) / 2, 640, 3);
  show_result();
  view_.source.connection.connection = SourceState::Connection::lost;
  EXPECT_TRUE(shown(Tone::bad));
  EXPECT_LT(high.y, 400) << "not over the middle of the picture";
  view_.source.connection.connection = SourceState::Connection::streaming;
  for (const Tone tone : {Tone::quiet, Tone::warning, Tone::bad}) EXPECT_FALSE(shown(tone));
}

class PictureDrawingTest : public WideTest {
 protected:
  PictureDrawingTest() {
    show_result();
    picture_.layout({640, 480}, {640, 480});
  }
  void draw(float left, float right, std::optional<ValueRange> depth = {}) {
    const PictureSide side{{0, 0}, {640, 480}, {left, 0}, {right, 480}, kStrip, is_b_};
    settled([&] { draw_over_picture(view_, side, picture_, depth); });
  }
  bool has(ImU32 colour) {
    ImVec2 low, high;
    return ImGuiFrames::box_of(colour, low, high);
  }
  static constexpr float kStrip = 27;
  PictureView picture_;
  bool is_b_ = false;
};

TEST_F(PictureDrawingTest, TheTitleNamesWhatIsCompared) {
  auto result = std::make_shared<ViewResult>(*view_.result);
  result->b.settings.kernel = 31;
  view_.result = result;
  EXPECT_EQ(picture_title(view_, false), "symmetry3d  kernel 15");
  state_.comparison = Comparison::split;
  EXPECT_EQ(picture_title(view_, true), "B  symmetry3d  kernel 31");
  state_.comparison = Comparison::difference;
  EXPECT_EQ(picture_title(view_, false), "A − B   symmetry3d  kernel 15 − symmetry3d  kernel 31");
}

TEST_F(PictureDrawingTest, EachValueOfAPixelHasItsName) {
  EXPECT_THAT(pixel_texts({3, 4}, 812, 0.5F),
              ::testing::ElementsAre("row 4  col 3   812 mm   saliency 0.50", "812 mm   saliency 0.50",
                                     "saliency 0.50"));
  EXPECT_EQ(pixel_texts({3, 4}, 0, 0)[1], "no depth   saliency 0");
}

TEST_F(PictureDrawingTest, AMarkOfBStandsForTheObjectOfAWithItsNumber) {
  auto result = std::make_shared<ViewResult>(*view_.result);
  view_.result = result;
  EXPECT_EQ(fixation_of_a(*result, 1, false), 1);
  EXPECT_EQ(fixation_of_a(*result, 1, true), -1) << "ranks name no object";
  auto &a = result->a.result.attention.fixations, &b = result->b.result.attention.fixations;
  a[0].id = 4;
  a[1].id = 2;
  b[0].id = 7;
  b[1].id = 4;
  EXPECT_EQ(fixation_of_a(*result, 1, true), 0);
  EXPECT_EQ(fixation_of_a(*result, 0, true), -1);
}

TEST_F(PictureDrawingTest, TheFirstFixationIsMarkedInGreenWhereItIs) {
  draw(0, 640);
  ImVec2 low, high;
  ASSERT_TRUE(ImGuiFrames::box_of(IM_COL32(88, 255, 120, 255), low, high));
  EXPECT_NEAR((low.x + high.x) / 2, 200.5, 1);
  EXPECT_NEAR((low.y + high.y) / 2, 100.5, 1);
  state_.style.marks = state_.style.path = false;
  draw(0, 640);
  EXPECT_FALSE(has(IM_COL32(88, 255, 120, 255)));
}

TEST_F(PictureDrawingTest, LegendsHaveTheColoursOfMapAndDepth) {
  const auto colour = [](cv::Vec3b c) { return IM_COL32(c[2], c[1], c[0], 255); };
  const auto map = colour(colours_of(Palette::turbo)[static_cast<std::size_t>(255 * std::sqrt(0.5 / 32))]);
  const auto depth = colour(depth_colour(Palette::viridis, 0.5 / 32));
  state_.style.depth.palette = Palette::viridis;
  draw(0, 640);
  EXPECT_TRUE(has(map));
  EXPECT_FALSE(has(depth));
  state_.show_map = false;
  draw(0, 640, ValueRange{500, 2000});
  EXPECT_FALSE(has(map));
  EXPECT_TRUE(has(depth));
}

TEST_F(PictureDrawingTest, WhereThereIsNoRoomNothingIsCutOff) {
  state_.comparison = Comparison::split;
  state_.style.marks = state_.style.path = false;
  ImVec2 low, high;
  for (const float right : {640.0F, 200.0F, 120.0F, 60.0F, 20.0F}) {
    draw(0, right, ValueRange{500, 2000});
    if (!ImGuiFrames::box_of(view_.colours->chip, low, high)) continue;
    EXPECT_GE(low.x, 0) << right;
    EXPECT_LE(high.x, right) << right;
  }
  is_b_ = true;
  for (const float left : {0.0F, 400.0F, 560.0F, 620.0F}) {
    draw(left, 640, ValueRange{500, 2000});
    if (!ImGuiFrames::box_of(view_.colours->chip, low, high)) continue;
    EXPECT_GE(low.x, left);
    EXPECT_LE(high.x, 640);
  }
}

TEST_F(PictureDrawingTest, TextsStandBesideThePicture) {
  state_.style.marks = state_.style.path = false;
  view_.pointer = cv::Point(100, 100);
  draw(0, 640, ValueRange{500, 2000});
  ImVec2 low, high;
  ASSERT_TRUE(ImGuiFrames::box_of(view_.colours->chip, low, high));
  EXPECT_LT(low.y, 0) << "the title is above it";
  EXPECT_GT(high.y, 480) << "values and legends are below it";
  for (const ImDrawVert& vertex : ImGui::GetDrawData()->CmdLists[0]->VtxBuffer)
    if (vertex.col == view_.colours->chip) {
      EXPECT_FALSE(vertex.pos.y > 0 && vertex.pos.y < 480) << vertex.pos.y;
    }
}

TEST_F(PictureDrawingTest, ALockedRangeThatShowsNothingIsExplained) {
  state_.style.map.range = ValueRange{10, 20};
  draw(0, 640);
  EXPECT_TRUE(has(colours_of(Theme::dark).warning));
  state_.style.map.range = ValueRange{0, 1};
  draw(0, 640);
  EXPECT_FALSE(has(colours_of(Theme::dark).warning));
}

TEST_F(PictureDrawingTest, AFrameWithoutColourKeepsTheLastOneAndSaysSo) {
  EXPECT_TRUE(view_.shown_frame().colour.empty());
  view_.last_colour = cv::Mat3b(480, 640, cv::Vec3b(1, 2, 3));
  EXPECT_EQ(view_.shown_frame().colour(0, 0), cv::Vec3b(1, 2, 3));
  draw(0, 640);
  EXPECT_TRUE(has(colours_of(Theme::dark).warning));
}

TEST_F(PictureDrawingTest, WhyThereIsNoMapIsWrittenOnThePicture) {
  auto result = std::make_shared<ViewResult>(*view_.result);
  result->a.error = "level 6 has only 10x8 pixels: 640x480 image (try --levels 0..5)";
  view_.result = result;
  draw(0, 640);
  EXPECT_TRUE(has(colours_of(Theme::dark).error));
}

}  // namespace
}  // namespace saccade
