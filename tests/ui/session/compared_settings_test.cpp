#include "ui/session/compared_settings.hpp"

#include <algorithm>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// No setting is the default.
Settings all_changed() {
  Settings s;
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"model", "itti"},
                                                                  {"kernel", "33"},
                                                                  {"levels", "1..3"},
                                                                  {"length-scale", "millimetre"},
                                                                  {"normalisation", "max"},
                                                                  {"simd", "scalar"},
                                                                  {"selector", "wta"},
                                                                  {"fixations", "3"},
                                                                  {"foa", "99"},
                                                                  {"frames", "5"},
                                                                  {"start", "2"},
                                                                  {"every", "3"},
                                                                  {"mode", "320x240@30"},
                                                                  {"registration", "false"},
                                                                  {"mirror", "true"},
                                                                  {"exposure", "7"},
                                                                  {"workers", "3"},
                                                                  {"intrinsics", "500,500,320,240"}})
    apply_setting(s, key, value);
  return s;
}

TEST(ComparedSettings, TheTunedSettingsAreCopiedAndNoOthers) {
  const Settings from = all_changed(), defaults;
  Settings to;
  copy_compared(from, to);
  for (const SettingSpec& spec : setting_specs())
    EXPECT_EQ(spec.print(to), spec.print(is_compared(spec) ? from : defaults)) << spec.key;
  EXPECT_TRUE(to.levels_chosen);
}

TEST(ComparedSettings, SidesShareSourceAndProgram) {
  ComparedSettings settings{all_changed(), {}};
  share_source(settings);
  EXPECT_EQ(settings.b.model, Settings{}.model);
  EXPECT_EQ(settings.b.sensor.mode, settings.a.sensor.mode);
  EXPECT_EQ(settings.b.workers, 3);
  swap_sides(settings);
  EXPECT_EQ(settings.b.model, "itti");
  EXPECT_EQ(settings.a.model, Settings{}.model);
  EXPECT_EQ(settings.a.sensor.exposure, 7) << "it is not swapped";
}

class LoadSettingsTest : public FolderTest {
 protected:
  std::vector<std::string> load(std::string_view text, bool into_b = false) {
    write_file(folder_ / "s.toml", text);
    return load_compared(settings_, into_b, (folder_ / "s.toml").string());
  }
  ComparedSettings settings_;
};

TEST_F(LoadSettingsTest, WhatTheFileDoesNotSayIsTheDefaultOrStays) {
  settings_.a = all_changed();
  share_source(settings_);
  EXPECT_THAT(load("kernel = 21"), IsEmpty());
  EXPECT_EQ(settings_.a.kernel, 21);
  EXPECT_EQ(settings_.a.model, "symmetry3d") << "tuned: the default";
  EXPECT_TRUE(settings_.a.intrinsics) << "of the source: as it was";
  EXPECT_EQ(settings_.a.workers, 3);
}

TEST_F(LoadSettingsTest, CameraAndSensorHoldForBothSides) {
  EXPECT_THAT(load("model = \"centre\"\nintrinsics = \"400,410,300,200\"\nmirror = true\n", true), IsEmpty());
  EXPECT_EQ(settings_.a.model, "symmetry3d");
  EXPECT_EQ(settings_.b.model, "centre");
  for (const Settings& side : {settings_.a, settings_.b}) {
    ASSERT_TRUE(side.intrinsics);
    EXPECT_EQ(side.intrinsics->fy, 410);
    EXPECT_TRUE(side.sensor.mirror);
  }
}

TEST_F(LoadSettingsTest, ReportsSettingsThatAWindowIgnores) {
  EXPECT_THAT(load("workers = 1\nframes = 9\nkernel = 9"), ElementsAre("frames", "workers"));
  EXPECT_EQ(settings_.a.workers, 0);
  EXPECT_EQ(settings_.a.kernel, 9);
}

TEST_F(LoadSettingsTest, ABadFileChangesNothing) {
  EXPECT_THROW(load("kernel = 9\nno-such = 1"), Error);
  EXPECT_EQ(settings_, ComparedSettings{});
}

}  // namespace
}  // namespace saccade
