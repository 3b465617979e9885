// No program or module that is built or installed loads libraries from the working directory.
#include "tests/house/run_path.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

void expect_fixed(const fs::path& file) {
  for (const std::string& entry : run_path(file))
    EXPECT_TRUE(is_fixed(entry)) << file << ": '" << entry << "'";
}

TEST(RunPath, OfEverythingThatIsBuilt) {
  std::vector<fs::path> binaries = find_binaries(BUILD_FOLDER);
  std::erase(binaries, fs::path(BAD_RUN_PATH));
  EXPECT_EQ(std::ranges::count(binaries, fs::path(saccade_program())), 1);
  for (const fs::path& file : binaries) expect_fixed(file);
}

class InstalledRunPath : public ProgramTest {};

TEST_F(InstalledRunPath, OfEverythingThatIsInstalled) {
  if (!fs::exists(CMAKE_PROGRAM)) GTEST_SKIP() << "cmake is not where it was when this was built";
  ASSERT_EQ(run_program(CMAKE_PROGRAM, {"--install", BUILD_FOLDER, "--prefix", in("prefix")}).status, 0);
  const std::vector<fs::path> binaries = find_binaries(folder_ / "prefix");
  EXPECT_EQ(std::ranges::count(binaries, folder_ / "prefix/bin/saccade"), 1);
  for (const fs::path& file : binaries) expect_fixed(file);
}

// The check itself, on a program that is linked with such a path.
TEST(RunPath, BadEntriesAreFound) {
  EXPECT_THAT(run_path(BAD_RUN_PATH), ElementsAre("/usr/lib", "relative/folder", ""));
  EXPECT_TRUE(is_fixed("/usr/lib"));
  EXPECT_TRUE(is_fixed("$ORIGIN/../lib"));
  EXPECT_FALSE(is_fixed("relative/folder"));
  EXPECT_FALSE(is_fixed(""));
}

}  // namespace
}  // namespace saccade
