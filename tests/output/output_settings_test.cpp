#include "output/output_settings.hpp"

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

}  // namespace
}  // namespace saccade
