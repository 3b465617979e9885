#include "ui/source_fit.hpp"

#include <gmock/gmock.h>

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SourceInfo source_of(cv::Size size, bool has_depth) {
  SourceInfo source;
  source.size = size;
  source.has_depth = has_depth;
  return source;
}

const SourceInfo kSensor = source_of({640, 480}, true), kCamera = source_of({640, 480}, false);

TEST(SourceFit, WithDepthEverythingStays) {
  Tuning tuning;
  EXPECT_THAT(SourceFit().fit(tuning, kSensor), IsEmpty());
  EXPECT_EQ(tuning, Tuning());
}

TEST(SourceFit, WithoutDepthAModelOfTheImageIsShownUntilThereIsDepthAgain) {
  Tuning tuning;
  tuning.b.model = "itti";
  const Tuning before = tuning;
  SourceFit fit;
  EXPECT_THAT(fit.fit(tuning, kCamera), ElementsAre(HasSubstr("symmetry3d needs depth")));
  EXPECT_EQ(tuning.a.model, "colour_symmetry2d");
  EXPECT_EQ(tuning.a.selector, Selector::wta);
  EXPECT_EQ(tuning.b.model, "itti") << "it needs none";
  EXPECT_THAT(fit.fit(tuning, kCamera), ElementsAre(HasSubstr("symmetry3d needs depth"))) << "another camera";
  EXPECT_THAT(fit.fit(tuning, kSensor), IsEmpty());
  EXPECT_EQ(tuning, before);
}

TEST(SourceFit, WhatWasChosenSinceStays) {
  Tuning tuning;
  SourceFit fit;
  fit.fit(tuning, kCamera);
  tuning.a.model = "radial2d";
  fit.fit(tuning, kSensor);
  EXPECT_EQ(tuning.a.model, "radial2d");
  EXPECT_EQ(tuning.a.selector, Selector::proto);
}

TEST(SourceFit, TellsOfTheSourceAndOfLevelsThatDoNotFit) {
  Tuning tuning;
  SourceInfo small = source_of({64, 48}, true);
  small.notes = {"a gap"};
  EXPECT_THAT(SourceFit().fit(tuning, small), ElementsAre("a gap", HasSubstr("room for levels 0..2")));
  tuning.a.levels_chosen = true;
  EXPECT_THAT(SourceFit().fit(tuning, small), ElementsAre("a gap"));
}

}  // namespace
}  // namespace saccade
