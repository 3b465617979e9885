#include "settings/settings.hpp"

#include <filesystem>
#include <set>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "settings/settings_format.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/other_value.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;

std::string error_of(const std::function<void()>& call, ExitStatus expected = ExitStatus::usage) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), expected);
    return error.what();
  }
  return "";
}

class SettingsFile : public FolderTest {
 protected:
  std::string load(Settings& settings, const std::string& toml,
                   ExitStatus expected = ExitStatus::usage) const {
    const std::filesystem::path path = folder_ / "a.toml";
    write_file(path, toml);
    return error_of([&] { load_settings(settings, path.string()); }, expected);
  }
};

TEST(Settings, PrintAndParseAreInverse) {
  Settings changed;
  apply_setting(changed, "kernel", "21");
  apply_setting(changed, "levels", "1..3");
  apply_setting(changed, "intrinsics", "500,501.5,320,240");
  apply_setting(changed, "dump", "levels,masks");
  for (const Settings& settings : {Settings{}, changed}) {
    Settings copy;
    for (const SettingSpec& spec : setting_specs())
      apply_setting(copy, std::string(spec.key), spec.print(settings));
    for (const SettingSpec& spec : setting_specs())
      EXPECT_EQ(spec.print(copy), spec.print(settings)) << spec.key;
  }
}

TEST(Settings, AreListedScopeByScope) {
  SettingScope last = SettingScope::model;
  std::set<std::string_view> keys;
  for (const SettingSpec& spec : setting_specs()) {
    EXPECT_GE(spec.scope, last) << spec.key;
    EXPECT_NE(title(spec.scope), "");
    EXPECT_NE(spec.help, "") << spec.key;
    EXPECT_TRUE(keys.insert(spec.key).second) << spec.key << " is there twice";
    last = spec.scope;
  }
  EXPECT_EQ(last, SettingScope::program);
}

TEST(Settings, ValuesAreComparedWithinTheirScope) {
  for (const SettingSpec& spec : setting_specs()) {
    const Settings other = changed(spec);
    EXPECT_FALSE(is_default(spec, other)) << spec.key;
    for (int i = 0; i <= static_cast<int>(SettingScope::program); ++i) {
      const auto scope = static_cast<SettingScope>(i);
      EXPECT_EQ(same_values(scope, Settings{}, other), scope != spec.scope) << spec.key;
    }
  }
}

TEST(Settings, ChosenLevelsAreNotTheDefaultOnes) {
  Settings s;
  EXPECT_TRUE(is_default(setting_spec("levels"), s));
  apply_setting(s, "levels", "0..4");
  EXPECT_FALSE(is_default(setting_spec("levels"), s));
  EXPECT_TRUE(same_values(SettingScope::model, Settings{}, s));
  EXPECT_THAT(settings_toml(s), HasSubstr("levels = \"0..4\""));
}

TEST(Settings, KernelIsChecked) {
  Settings s;
  for (const char* bad : {"2", "128", "15.5", "", "abc", "-3", "1 5"})
    EXPECT_THAT(error_of([&] { apply_setting(s, "kernel", bad); }), HasSubstr("3..127")) << bad;
  EXPECT_EQ(s.kernel, 15);
  apply_setting(s, "kernel", "127");
  EXPECT_EQ(s.kernel, 127);
}

TEST(Settings, WorkersAreChecked) {
  Settings s;
  apply_setting(s, "workers", "256");
  EXPECT_EQ(s.workers, 256);
  for (const char* bad : {"257", "-1"})
    EXPECT_THAT(error_of([&] { apply_setting(s, "workers", bad); }), HasSubstr("0..256")) << bad;
}

TEST(Settings, BlanksAroundValuesDoNotMatter) {
  Settings s;
  apply_setting(s, "kernel", " 21 ");
  EXPECT_EQ(s.kernel, 21);
  apply_setting(s, "intrinsics", "525, 526, 319.5 , 239.5");
  ASSERT_TRUE(s.intrinsics);
  EXPECT_EQ(std::tuple(s.intrinsics->fx, s.intrinsics->fy, s.intrinsics->cx, s.intrinsics->cy),
            std::tuple(525, 526, 319.5, 239.5));
  apply_setting(s, "levels", "1 .. 3");
  EXPECT_EQ(std::pair(s.first_level, s.last_level), std::pair(1, 3));
  apply_setting(s, "depth-range", " 500 .. 2500.5");
  EXPECT_EQ(s.overlay.depth.range_mm->high, 2500.5F);
  apply_setting(s, "selector", "wta ");
  EXPECT_EQ(s.selector, Selector::wta);
}

TEST(Settings, AFractionWhereAnIntegerIsNeededIsRefusedWithThatReason) {
  Settings s;
  for (const char* key : {"kernel", "fixations", "frames", "workers", "exposure", "levels"})
    EXPECT_THAT(error_of([&] { apply_setting(s, key, "15.5"); }), HasSubstr("integer")) << key;
  EXPECT_THAT(error_of([&] { apply_setting(s, "dwell", "x"); }), HasSubstr("a number in 0..60"));
}

TEST(Settings, LevelsAreARangeOrOneNumber) {
  Settings s;
  apply_setting(s, "levels", "2");
  EXPECT_EQ(s.first_level, 2);
  EXPECT_EQ(s.last_level, 2);
  for (const char* bad : {"3..1", "..", "0..", "-1..3", "0..13", "a..b"})
    EXPECT_NE(error_of([&] { apply_setting(s, "levels", bad); }), "") << bad;
}

TEST(Settings, IntrinsicsMustBeACamera) {
  Settings s;
  for (const char* bad : {"1,2,3", "nan,525,320,240", "-525,525,320,240", "0,1,2,3", "inf,1,1,1", "a,b,c,d"})
    EXPECT_THAT(error_of([&] { apply_setting(s, "intrinsics", bad); }), HasSubstr("fx,fy,cx,cy")) << bad;
}

TEST(Settings, UnknownKeyNamesTheNearest) {
  Settings s;
  EXPECT_THAT(error_of([&] { apply_setting(s, "kernal", "15"); }), HasSubstr("did you mean kernel?"));
}

TEST_F(SettingsFile, OverridesTheDefaults) {
  Settings s;
  EXPECT_EQ(load(s,
                 "kernel = 21\nlevels = \"0..2\"\nlength-scale = 'millimetre'\ndump = [\"maps\", \"masks\"]\n"
                 "quiet = true\nfoa = 32\n"),
            "");
  EXPECT_EQ(s.kernel, 21);
  EXPECT_EQ(s.last_level, 2);
  EXPECT_EQ(s.length_scale, LengthScale::millimetre);
  EXPECT_EQ(s.dump, (std::set<std::string>{"maps", "masks"}));
  EXPECT_TRUE(s.quiet);
  EXPECT_EQ(s.foa, 32);
}

TEST_F(SettingsFile, ErrorsNameTheLine) {
  Settings s;
  EXPECT_THAT(load(s, "kernel = 15\nkernle = 3\n"), HasSubstr(".toml:2"));
  EXPECT_THAT(load(s, "kernel = 200\n"), HasSubstr("3..127"));
  EXPECT_THAT(load(s, "kernel = = 3\n"), HasSubstr("not valid TOML"));
  EXPECT_THAT(load(s, "[kernel]\nk = 3\n"), HasSubstr(".toml:1"));
}

TEST_F(SettingsFile, AFormatThatIsNotKnownIsRefused) {
  Settings s;
  const std::string newer = std::to_string(kSettingsFormat + 1);
  EXPECT_EQ(load(s, "format = " + std::to_string(kSettingsFormat) + "\nkernel = 21\n"), "");
  EXPECT_THAT(load(s, "format = " + newer + "\n"), HasSubstr("settings of format " + newer));
  for (const char* bad : {"0", "-1", "1.5", "\"1\""})
    EXPECT_THAT(load(s, std::string("format = ") + bad + "\n"), HasSubstr("bad value for format")) << bad;
}

TEST_F(SettingsFile, AHugeOneIsRefused) {
  Settings s;
  EXPECT_THAT(load(s, std::string((1 << 20) + 1, '#'), ExitStatus::unreadable), HasSubstr("too large"));
}

std::string config_file(const char* name) { return in_source("config/") + name; }

TEST(Settings, DefaultTomlListsEveryKeyWithItsDefault) {
  const auto bytes = read_file(config_file("default.toml"));
  const std::string text(bytes.begin(), bytes.end());
  for (const SettingSpec& spec : setting_specs())
    EXPECT_THAT(text, HasSubstr("\n" + std::string(spec.key) + " = ")) << "not documented";
  Settings loaded;
  for (const SettingSpec& spec : setting_specs())  // start from another value, to detect a missing line
    if (spec.key == "kernel") spec.parse(loaded, "99");
  load_settings(loaded, config_file("default.toml"));
  for (const SettingSpec& spec : setting_specs())
    EXPECT_EQ(spec.print(loaded), spec.print(Settings{})) << spec.key;
}

TEST(Settings, PaperTomlHasTheSettingsOfThePaper) {
  Settings s;
  load_settings(s, config_file("paper.toml"));
  EXPECT_EQ(s.kernel, 15);
  EXPECT_EQ(s.first_level, 0);
  EXPECT_EQ(s.last_level, 4);
  EXPECT_EQ(s.length_scale, LengthScale::millimetre);
  EXPECT_EQ(s.selector, Selector::wta);
}

TEST(Settings, TheNullDeviceChangesNothing) {
  Settings s;
  s.kernel = 9;
  load_settings(s, "/dev/null");
  EXPECT_EQ(s.kernel, 9);
}

TEST(Settings, MissingFileIsUnreadable) {
  Settings s;
  EXPECT_THAT(error_of([&] { load_settings(s, "/nowhere/x.toml"); }, ExitStatus::unreadable),
              HasSubstr("/nowhere/x.toml"));
}

}  // namespace
}  // namespace saccade
