#include "app/command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SourceInfo plain_camera() {
  SourceInfo source;
  source.uri = "walk.avi";
  source.has_depth = false;
  return source;
}

TEST(FitToDepth, LeavesSourcesWithDepthAlone) {
  Settings settings;
  SourceInfo source;
  fit_to_depth(settings, source);
  EXPECT_EQ(settings.selector, Selector::proto);
  EXPECT_THAT(source.notes, IsEmpty());
}

TEST(FitToDepth, RefusesModelsThatNeedDepthWithoutIt) {
  for (const char* model : {"symmetry3d", "combined"}) {
    Settings settings;
    settings.model = model;
    SourceInfo source = plain_camera();
    try {
      fit_to_depth(settings, source);
      ADD_FAILURE() << model;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::usage);
      EXPECT_THAT(error.what(), HasSubstr("needs depth"));
      EXPECT_THAT(error.what(), HasSubstr("walk.avi"));
    }
  }
}

TEST(FitToDepth, ChoosesPointsWithoutDepth) {
  Settings settings;
  settings.model = "itti";
  SourceInfo source = plain_camera();
  fit_to_depth(settings, source);
  EXPECT_EQ(settings.selector, Selector::wta);
  EXPECT_THAT(source.notes, Contains(HasSubstr("wta")));
}

}  // namespace
}  // namespace saccade
