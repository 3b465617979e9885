#include "ui/session/view_state.hpp"

#include <gmock/gmock.h>

#include "ui/session/command_line.hpp"
#include "ui/session/settings_history.hpp"
#include "ui/session/shortcuts.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;

TEST(Shortcuts, NoKeyDoesTwoThings) {
  const auto list = shortcuts();
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = i + 1; k < list.size(); ++k)
      EXPECT_FALSE(list[i].key == list[k].key && list[i].ctrl == list[k].ctrl &&
                   list[i].shift == list[k].shift)
          << key_name(list[i]) << ": " << list[i].text << " and " << list[k].text;
}

TEST(Shortcuts, EachIsFoundByItsKeyAndExplained) {
  for (const Shortcut& s : shortcuts()) {
    EXPECT_EQ(action_of(s.key, s.ctrl, s.shift), s.action);
    EXPECT_FALSE(s.text.empty());
    EXPECT_FALSE(s.group.empty());
    EXPECT_FALSE(key_name(s.action).empty());
  }
  EXPECT_EQ(action_of(key_of('Z'), true, true), Action::redo);
  EXPECT_EQ(action_of(key_of('\\'), false, false), std::nullopt);
  EXPECT_EQ(key_name(Action::redo), "Ctrl+Shift+Z");
  EXPECT_EQ(key_name(Action::play_pause), "Space");
}

TEST(Shortcuts, CharactersAreTypedWithoutShift) {
  // Characters that are no letters come as they were typed; a table entry with Shift would never be found.
  for (const Shortcut& s : shortcuts()) {
    const int key = static_cast<int>(s.key);
    const bool typed = key > ' ' && key < 0x100 && !(key >= 'A' && key <= 'Z');
    EXPECT_FALSE(typed && (s.shift || s.ctrl)) << key_name(s);
  }
}

TEST(ViewState, ComesBackFromItsJson) {
  ViewState state;
  state.settings.a.model = "combined";
  state.settings.a.kernel = 33;
  apply_setting(state.settings.b, "levels", "1..3");
  state.style.background = Background::depth;
  state.style.map = {Palette::inferno, 0.5, 0.25, ValueRange{0.5F, 2}};
  state.style.depth.range_mm = ValueRange{600, 2500};
  state.style.depth.percentile = 5;
  state.style.path = false;
  state.comparison = Comparison::split;
  state.divider = 0.3;
  state.centre = Centre::both;
  state.cloud = {CloudColour::saliency, false, true, false, 2.5F};
  state.theme = Theme::light;
  state.sidebar_width = 420;
  state.is_open(SidebarPanel::probe) = true;
  state.window = {1500, 900};
  remember_source(state, "a.oni");
  remember_source(state, "b");

  ViewState back;
  apply_view_state(back, view_state_json(state));
  EXPECT_EQ(view_state_json(back), view_state_json(state));
  EXPECT_TRUE(back.settings == state.settings);
  EXPECT_EQ(back.style.map, state.style.map);
  EXPECT_EQ(back.cloud, state.cloud);
  EXPECT_EQ(back.window, state.window);
  EXPECT_THAT(back.recent, ElementsAre("b", "a.oni"));
}

TEST(ViewState, KeepsWhatASpoiledFileDoesNotSay) {
  for (const char* text :
       {"", "[]", "{", "{\"theme\": 7, \"window\": [1], \"settings\": {\"kernel\": \"999\"}}",
        "{\"map_range\": [2, 1], \"open\": 3, \"recent\": [1], \"map_opacity\": \"much\"}",
        "{\"settings\": {\"no-such\": \"1\"}, \"window\": [1e99, -4]}"}) {
    ViewState state;
    apply_view_state(state, text);
    EXPECT_EQ(view_state_json(state), view_state_json(ViewState{})) << text;
  }
}

TEST(ViewState, RunOptionsAreNotKept) {
  ViewState state;
  state.settings.a.start = 12;
  state.settings.a.workers = 3;
  ViewState back;
  apply_view_state(back, view_state_json(state));
  EXPECT_EQ(back.settings.a.start, 0);
  EXPECT_EQ(back.settings.a.workers, 0);
}

TEST(ViewState, RecentSourcesAreShortAndWithoutRepeats) {
  ViewState state;
  for (int i = 0; i < 20; ++i) remember_source(state, std::to_string(i % 10));
  EXPECT_EQ(state.recent.size(), kMostRecent);
  EXPECT_EQ(state.recent.front(), "9");
  remember_source(state, "5");
  EXPECT_EQ(state.recent.front(), "5");
  EXPECT_EQ(state.recent.size(), kMostRecent);
}

TEST(ViewState, StepsThroughModelsKernelsAndSpeeds) {
  Settings s;
  const auto models = choices_of("model");
  ASSERT_GT(models.size(), 3u);
  for (std::size_t i = 0; i < models.size(); ++i) next_model(s, 1);
  EXPECT_EQ(s.model, "symmetry3d") << "around";
  next_model(s, -1);
  EXPECT_EQ(s.model, models.back());

  EXPECT_EQ(next_kernel(15, 1), 17);
  EXPECT_EQ(next_kernel(3, -1), 3);
  EXPECT_EQ(next_kernel(127, 1), 127);
  EXPECT_EQ(next_kernel(14, 1), 17);

  EXPECT_EQ(next_speed(1, 1), 2);
  EXPECT_EQ(next_speed(8, 1), 0) << "as fast as possible";
  EXPECT_EQ(next_speed(0, 1), 0);
  EXPECT_EQ(next_speed(0, -1), 8);
  EXPECT_EQ(next_speed(0.1, -1), 0.1);
}

TEST(CommandLine, HoldsOnlySettingsThatDifferFromTheDefault) {
  Settings s;
  EXPECT_EQ(run_command_line("saccade", "a b.oni", s, PlayRange{7, 1, 1}),
            "saccade run 'a b.oni' --out out/view --frames 1 --start 7");
  s.kernel = 31;
  s.model = "combined";
  s.quiet = true;
  s.sensor.registration = false;
  s.sensor.mirror = true;
  s.overlay.map.palette = Palette::viridis;
  s.overlay.map.range = ValueRange{0, 0.1F};
  s.overlay.path = false;
  apply_setting(s, "levels", "0..4");
  EXPECT_EQ(
      run_command_line("/opt/my tools/saccade", "dir", s, std::nullopt),
      "'/opt/my tools/saccade' run dir --out out/view --model combined --kernel 31 --levels 0..4 "
      "--no-registration --mirror --overlay fixations,outlines --map-colours viridis --map-range 0..0.1");
}

TEST(CommandLine, APartOfARecordingHasAStartAndALength) {
  EXPECT_EQ(run_command_line("saccade", "a.oni", {}, PlayRange{20, 1, 11}),
            "saccade run a.oni --out out/view --frames 11 --start 20");
  EXPECT_EQ(run_command_line("saccade", "a.oni", {}, PlayRange{20, 1, 0}),
            "saccade run a.oni --out out/view --start 20");
}

TEST(CommandLine, WordsSurviveAShell) {
  EXPECT_EQ(shell_word("plain-1.oni"), "plain-1.oni");
  EXPECT_EQ(shell_word("synthetic:room?seed=3&noise=kinect"), "'synthetic:room?seed=3&noise=kinect'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(SettingsHistory, UndoesAndRedoesWholeSteps) {
  SettingsHistory history({});
  ComparedSettings t;
  EXPECT_FALSE(history.can_undo());
  for (const int kernel : {17, 19, 21}) {  // one drag
    t.a.kernel = kernel;
    history.change(t);
  }
  history.commit();
  t.b.model = "itti";
  history.change(t);
  history.commit();
  history.commit();  // nothing new: no step

  history.undo();
  EXPECT_EQ(history.now().b.model, "symmetry3d");
  EXPECT_EQ(history.now().a.kernel, 21);
  history.undo();
  EXPECT_EQ(history.now().a.kernel, 15) << "the drag is one step";
  EXPECT_FALSE(history.can_undo());
  history.redo();
  history.redo();
  EXPECT_EQ(history.now().b.model, "itti");
  EXPECT_FALSE(history.can_redo());

  history.undo();
  t = history.now();
  t.a.kernel = 5;
  history.change(t);
  history.commit();
  EXPECT_FALSE(history.can_redo()) << "another way was taken";
  for (int i = 0; i < 500; ++i) {
    t.a.fixations = 1 + i;
    history.change(t);
    history.commit();
  }
  for (int i = 0; i < 500; ++i) history.undo();
  EXPECT_FALSE(history.can_undo()) << "old steps are forgotten, none is invented";
}

}  // namespace
}  // namespace saccade
