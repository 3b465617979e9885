#include "output/output_settings.hpp"

#include <algorithm>

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;

TEST(OutputSettings, FilesOfByProductsRequestThem) {
  const RequestedOutputs none = requested_outputs({.dump = {"maps", "overlay", "masks", "labels"}});
  EXPECT_FALSE(none.levels || none.normals);
  EXPECT_TRUE(requested_outputs({.dump = {"levels"}}).levels);
  EXPECT_TRUE(requested_outputs({.dump = {"normals"}}).normals);
}

TEST(OutputSettings, ByProductsThatAModelDoesNotHaveAreRefused) {
  const OutputSettings normals{.dump = {"maps", "normals"}};
  EXPECT_NO_THROW(check_dump(normals, "symmetry3d"));
  EXPECT_NO_THROW(check_dump({}, "itti"));
  try {
    check_dump(normals, "itti");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
    EXPECT_THAT(error.what(), HasSubstr("--dump maps,normals"));
    EXPECT_THAT(error.what(), HasSubstr("--model symmetry3d or combined"));
  }
}

// What each setting prints, it reads.
TEST(OutputSettings, TheOverlayIsSetAndPrinted) {
  OutputSettings settings;
  for (const auto& [key, text] : {std::pair("overlay", "path"),
                                  {"background", "depth"},
                                  {"map-colours", "inferno"},
                                  {"map-range", "0.5..2"},
                                  {"map-opacity", "0.25"},
                                  {"map-threshold", "0.1"},
                                  {"depth-colours", "turbo"},
                                  {"depth-range", "400..3000"},
                                  {"depth-percentile", "2.5"},
                                  {"dump", "cloud,colour,depth"}}) {
    const auto specs = output_setting_specs();
    const auto spec = std::ranges::find(specs, std::string_view(key), &SettingOf<OutputSettings>::key);
    ASSERT_NE(spec, specs.end()) << key;
    spec->parse(settings, text);
    EXPECT_EQ(spec->print(settings), text) << key;
    EXPECT_THROW(spec->parse(settings, "no such"), std::invalid_argument) << key;
  }
  const OverlayStyle& style = settings.overlay;
  EXPECT_TRUE(style.path && !style.marks && !style.outlines);
  EXPECT_EQ(style.map.range, (ValueRange{0.5F, 2}));
  EXPECT_EQ(style.depth.range_mm, (ValueRange{400, 3000}));
  EXPECT_EQ(style.depth.percentile, 2.5);
}

}  // namespace
}  // namespace saccade
