// The installed program finds OpenNI2 and the driver modules beside itself.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class InstallTest : public ProgramTest {
 protected:
  ~InstallTest() override { ::unsetenv("SACCADE_VIRTUAL_DEVICE"); }
};

TEST_F(InstallTest, TheInstalledProgramHasItsOwnDriverModules) {
  if (!fs::exists(CMAKE_PROGRAM)) GTEST_SKIP() << "cmake is not where it was when this was built";
  const ProgramResult installed =
      run_program(CMAKE_PROGRAM, {"--install", BUILD_FOLDER, "--prefix", in("prefix")});
  ASSERT_EQ(installed.status, 0) << installed.err;
  const std::string program = in("prefix/bin/saccade");
  ::setenv("SACCADE_VIRTUAL_DEVICE", "synthetic:table?size=160x120", 1);

  const json report = json::parse(run_program(program, {"doctor", "--json", "--sysfs", in("sys")}).out);
  EXPECT_TRUE(report["ok"]) << report["problems"];
  const json& openni2 = report["openni2"];
  EXPECT_THAT(openni2["library"].get<std::string>(), HasSubstr("prefix/"));
  const std::string drivers = fs::canonical(openni2["driver_folder"].get<std::string>());
  EXPECT_THAT(drivers, StartsWith(fs::canonical(in("prefix")).string()));
  std::size_t ours = 0;
  for (const json& module : openni2["modules"]) {
    if (!module["name"].get<std::string>().starts_with("Saccade")) continue;
    EXPECT_FALSE(fs::is_symlink(module["path"].get<std::string>())) << "of its own, not of the build tree";
    ++ours;
  }
  EXPECT_EQ(ours, 2U);

  EXPECT_THAT(run_program(program, {"devices"}).out, HasSubstr("openni2:saccade-virtual://0"));
  const ProgramResult run =
      run_program(program, {"run", "openni2", "--frames", "3", "--out", in("out"), "--dump", "none"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string fixations = text("out/fixations.jsonl");
  EXPECT_EQ(std::count(fixations.begin(), fixations.end(), '\n'), 3);
}

}  // namespace
}  // namespace saccade
