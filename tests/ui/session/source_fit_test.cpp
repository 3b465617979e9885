#include "ui/session/source_fit.hpp"

#include <gmock/gmock.h>

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

SourceInfo source_of(cv::Size size, bool has_depth) {
  SourceInfo source;
  source.size = size;
  source.has_depth = has_depth;
  return source;
}

const SourceInfo kSensor = source_of({640, 480}, true), kPlainCamera = source_of({640, 480}, false);

TEST(SourceFit, WithDepthEverythingStays) {
  ComparedSettings settings;
  EXPECT_THAT(SourceFit().fit(settings, kSensor), IsEmpty());
  EXPECT_EQ(settings, ComparedSettings());
}

TEST(SourceFit, WithoutDepthAModelOfTheImageIsShownUntilThereIsDepthAgain) {
  ComparedSettings settings;
  settings.b.model = "itti";
  const ComparedSettings before = settings;
  SourceFit fit;
  EXPECT_THAT(fit.fit(settings, kPlainCamera), ElementsAre(HasSubstr("symmetry3d needs depth")));
  EXPECT_EQ(settings.a.model, "colour_symmetry2d");
  EXPECT_EQ(settings.a.selector, Selector::wta);
  EXPECT_EQ(settings.b.model, "itti") << "it needs none";
  EXPECT_THAT(fit.fit(settings, kPlainCamera), ElementsAre(HasSubstr("symmetry3d needs depth")))
      << "another camera";
  EXPECT_THAT(fit.fit(settings, kSensor), IsEmpty());
  EXPECT_EQ(settings, before);
}

TEST(SourceFit, AChoiceSinceStays) {
  ComparedSettings settings;
  SourceFit fit;
  EXPECT_THAT(fit.fit(settings, kPlainCamera), SizeIs(1));
  settings.a.model = "radial2d";
  EXPECT_THAT(fit.fit(settings, kSensor), IsEmpty());
  EXPECT_EQ(settings.a.model, "radial2d");
  EXPECT_EQ(settings.a.selector, Selector::proto);
}

TEST(SourceFit, ReportsNotesOfTheSourceAndLevelsThatDoNotFit) {
  ComparedSettings settings;
  SourceInfo small = source_of({64, 48}, true);
  small.notes = {"a gap"};
  EXPECT_THAT(SourceFit().fit(settings, small), ElementsAre("a gap", HasSubstr("room for levels 0..2")));
  settings.a.levels_chosen = true;
  EXPECT_THAT(SourceFit().fit(settings, small), ElementsAre("a gap"));
}

TEST(SourceFit, OnlySourcesWithoutTimesHaveStills) {
  SourceInfo source;
  for (const char* kind : {"folder", "osd", "images", "nyu"}) {
    source.kind = kind;
    EXPECT_TRUE(has_stills(source)) << kind;
  }
  for (const char* kind : {"oni", "tum", "video", "synthetic", "openni2"}) {
    source.kind = kind;
    EXPECT_FALSE(has_stills(source)) << kind;
  }
}

}  // namespace
}  // namespace saccade
