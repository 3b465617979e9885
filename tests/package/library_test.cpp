// The installed C++ library, as somebody else's project uses it.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class LibraryTest : public ProgramTest {
 protected:
  // The first block of src/README.md in this language.
  static std::string example(const std::string& language) {
    const auto bytes = read_file(in_source("src/README.md"), 1u << 20);
    const std::string readme(bytes.begin(), bytes.end());
    const std::size_t begin = readme.find("```" + language + "\n");
    const std::size_t end = readme.find("```\n", begin + 3);
    EXPECT_LT(end, readme.size());
    return readme.substr(begin + language.size() + 4, end - begin - language.size() - 4);
  }

  void install() const {
    const ProgramResult installed =
        run_program(CMAKE_PROGRAM, {"--install", BUILD_FOLDER, "--prefix", in("first")});
    ASSERT_EQ(installed.status, 0) << installed.err;
    fs::rename(in("first"), in("prefix"));  // it can be moved
  }

  void build_consumer() const {
    fs::copy(in_source("tests/package/consumer"), in("consumer"));
    write_file(in("consumer/look.cpp"), example("cpp"));
    const ProgramResult configured =
        run_program(CMAKE_PROGRAM, {"-S", in("consumer"), "-B", in("build"), "-G", "Ninja",
                                    "-DCMAKE_PREFIX_PATH=" + in("prefix"), "-DCMAKE_BUILD_TYPE=None"});
    ASSERT_EQ(configured.status, 0) << configured.err;
    const ProgramResult built = run_program(CMAKE_PROGRAM, {"--build", in("build")});
    ASSERT_EQ(built.status, 0) << built.out;
  }
};

TEST_F(LibraryTest, TheExampleGivesTheFixationsOfRun) {
  ASSERT_NO_FATAL_FAILURE(install());
  ASSERT_NO_FATAL_FAILURE(build_consumer());
  fs::create_directory(in("frames"));
  const std::string recording = in_source("recordings/table.oni");
  const ProgramResult wrote = run_program(in("build/write_depth"), {recording, in("frames/0000_depth.png")});
  ASSERT_EQ(wrote.status, 0) << wrote.err;

  const ProgramResult look = run_program(in("build/look"), {in("frames/0000_depth.png")});
  ASSERT_EQ(look.status, 0) << look.err;
  EXPECT_EQ(look.err, "");
  const ProgramResult run =
      run_program(in("prefix/bin/saccade"), {"run", in("frames"), "--intrinsics", "525,525,319.5,239.5",
                                             "--fixations", "5", "--dump", "none", "--out", in("out")});
  ASSERT_EQ(run.status, 0) << run.err;
  const json fixations = json::parse(text("out/fixations.jsonl"))["fixations"];
  ASSERT_GE(fixations.size(), 2U);
  std::istringstream lines(look.out);
  for (const json& fixation : fixations) {
    int row = 0, col = 0;
    float saliency = 0, z_mm = 0;
    ASSERT_TRUE(lines >> row >> col >> saliency >> z_mm) << look.out;
    EXPECT_EQ(row, fixation["row"]);
    EXPECT_EQ(col, fixation["col"]);
    EXPECT_EQ(saliency, fixation["saliency"].get<float>());
    EXPECT_EQ(z_mm, fixation["z_mm"].get<float>());
  }
  std::string rest;
  EXPECT_FALSE(lines >> rest) << rest;
}

TEST_F(LibraryTest, TheExampleProjectIsTheOneThatIsTested) {
  std::istringstream lines(example("cmake"));
  const auto bytes = read_file(in_source("tests/package/consumer/CMakeLists.txt"), 1u << 20);
  const std::string tested(bytes.begin(), bytes.end());
  for (std::string line; std::getline(lines, line);) EXPECT_THAT(tested, HasSubstr(line + "\n"));
}

TEST_F(LibraryTest, NoFileNamesTheFolderOfTheBuild) {
  ASSERT_NO_FATAL_FAILURE(install());
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(in("prefix"))) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".cmake" && ending != ".hpp") continue;
    ++files;
    const auto bytes = read_file(entry.path(), 1u << 20);
    EXPECT_THAT(std::string(bytes.begin(), bytes.end()), Not(HasSubstr(in_source("")))) << entry.path();
  }
  EXPECT_GT(files, 20U);
}

}  // namespace
}  // namespace saccade
