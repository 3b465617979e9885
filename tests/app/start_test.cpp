// Which libraries the program loads at its start.
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>

extern "C" {
#include <libavutil/avutil.h>
}

#include "core/file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class StartTest : public ProgramTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_saccade({"export", in_source("recordings/table.oni"), "--out", in("video"), "--frames", "2",
                           "--format", "video"})
                  .status,
              0);
  }
  ProgramResult run_video() const {
    return run_saccade({"run", in("video/frames_depth.mkv"), "--out", in("out"), "--dump", "none"});
  }
};

TEST_F(StartTest, TheVideoLibrariesAreLoadedWhereAVideoIsReadOnly) {
  ::setenv("LD_TRACE_LOADED_OBJECTS", "1",
           1);  // the loader lists the libraries instead of starting the program
  const ProgramResult listed = run_program(saccade_program(), {});
  ::unsetenv("LD_TRACE_LOADED_OBJECTS");
  EXPECT_THAT(listed.out,
              AllOf(HasSubstr("libopencv_core"), Not(HasSubstr("libav")), Not(HasSubstr("libsw"))));
  const ProgramResult outcome = run_video();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(StartTest, AVideoLibraryThatCannotBeLoadedIsReported) {
  const std::string library = "libavutil.so." AV_STRINGIFY(LIBAVUTIL_VERSION_MAJOR);
  write_file(in(library), std::string_view("no library"));
  ::setenv("LD_LIBRARY_PATH", folder_.c_str(), 1);
  const ProgramResult outcome = run_video();
  ::unsetenv("LD_LIBRARY_PATH");
  EXPECT_NE(outcome.status, 0);
  EXPECT_TRUE(outcome.one_error_line());
  EXPECT_THAT(outcome.err, HasSubstr(library));
}

}  // namespace
}  // namespace saccade
