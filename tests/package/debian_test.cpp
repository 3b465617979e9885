// The Debian package: made by cpack, checked by lintian, unpacked into an empty folder and used there.
#include <cstdlib>
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/version.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

bool have(const std::string& tool) { return run_program("sh", {"-c", "command -v " + tool}).status == 0; }

class DebianTest : public ProgramTest {
 protected:
  ~DebianTest() override { ::unsetenv("SACCADE_VIRTUAL_DEVICE"); }

  void unpack() {
    const ProgramResult packed = run_program(
        "cpack", {"-G", "DEB", "--config", BUILD_FOLDER "/CPackConfig.cmake", "-B", in("package")});
    ASSERT_EQ(packed.status, 0) << packed.out << packed.err;
    for (const auto& entry : fs::directory_iterator(in("package")))
      if (entry.path().extension() == ".deb") package_ = entry.path();
    ASSERT_FALSE(package_.empty());
    const ProgramResult unpacked = run_program("dpkg-deb", {"-x", package_, in("root")});
    ASSERT_EQ(unpacked.status, 0) << unpacked.err;
  }

  std::string field(const std::string& name) const {
    return run_program("dpkg-deb", {"-f", package_, name}).out;
  }
  std::string installed(const std::string& name) const { return in("root/usr/" + name); }
  ProgramResult saccade(const std::vector<std::string>& arguments) const {
    return run_program(installed("bin/saccade"), arguments);
  }

  void check_dependencies() const;
  void check_with_lintian() const;
  void check_pages_and_completion() const;
  void check_run() const;
  void check_settings() const;
  void check_sensors() const;
  void check_viewer() const;
  void check_python() const;

  std::string package_;
};

#define SKIP_WITHOUT(tool) \
  if (!have(tool)) GTEST_SKIP() << tool << " is not installed"

// All that needs the package is one test, since making it takes a while.
TEST_F(DebianTest, ThePackageIsRightAndItsProgramWorks) {
  SKIP_WITHOUT("dpkg-shlibdeps");
  ASSERT_NO_FATAL_FAILURE(unpack());
  check_dependencies();
  check_with_lintian();
  check_pages_and_completion();
  check_run();
  check_settings();
  check_sensors();
  check_viewer();
  check_python();
}

void DebianTest::check_dependencies() const {
  EXPECT_EQ(field("Version"), std::string(kVersion) + "\n");
  const std::string depends = field("Depends");
  EXPECT_THAT(depends, HasSubstr("libavformat")) << "which is not linked, but opened";
  for (const char* package : {"libc6", "libopencv-core406", "libspng0"})
    EXPECT_THAT(depends, HasSubstr(package));
#ifdef SACCADE_HAS_VIEWER
  for (const char* package : {"libglfw3", "libgl1", "libxi6", "fonts-dejavu-core"})
    EXPECT_THAT(depends, HasSubstr(package));
#endif
}

void DebianTest::check_with_lintian() const {
  if (!have("lintian")) return;
  const ProgramResult lintian = run_program("lintian", {"--allow-root", "--fail-on", "error", package_});
  EXPECT_EQ(lintian.status, 0) << lintian.out << lintian.err;
}

void DebianTest::check_run() const {
  const json version = json::parse(saccade({"--version", "--json"}).out);
  EXPECT_EQ(version["version"], kVersion);
  const ProgramResult run = saccade(
      {"run", installed("share/saccade/table.oni"), "--frames", "1", "--dump", "none", "--out", in("out")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(json::parse(text("out/manifest.json"))["formats"], version["formats"].patch(json::parse(R"(
      [{"op": "remove", "path": "/evaluation"}])")));
}

void DebianTest::check_settings() const {
  const ProgramResult defaults = saccade({"settings", "--default"});
  write_file(in("all.toml"), defaults.out);
  EXPECT_THAT(saccade({"settings", "--config", in("all.toml"), "--kernel", "31"}).out,
              HasSubstr("\nformat = 1\nkernel = 31\n"));
}

void DebianTest::check_sensors() const {
#ifdef SACCADE_HAS_SENSORS
  EXPECT_TRUE(
      json::parse(saccade({"doctor", "--json", "--sysfs", in("sys")}).out)["openni2"]["in_this_build"]);
  ::setenv("SACCADE_VIRTUAL_DEVICE", "synthetic:table?size=160x120", 1);
  const ProgramResult live =
      saccade({"run", "openni2", "--frames", "2", "--dump", "none", "--out", in("live")});
  EXPECT_EQ(live.status, 0) << live.err;
#endif
}

void DebianTest::check_viewer() const {
#ifdef SACCADE_HAS_VIEWER
  if (!have("xvfb-run")) return;
  ::setenv("XDG_CONFIG_HOME", in("config").c_str(), 1);
  const ProgramResult view = run_program(
      "xvfb-run", {"-a", installed("bin/saccade"), "view", "--paused", "--screenshot", in("window.png")});
  EXPECT_EQ(view.status, 0) << view.err;
  EXPECT_GT(fs::file_size(in("window.png")), 10'000U);
#endif
}

// The module is found where Debian's python3 looks, and finds the driver modules of the package.
void DebianTest::check_python() const {
#ifdef SACCADE_PYTHON
  EXPECT_THAT(field("Recommends"), HasSubstr("python3-numpy"));
  ::setenv("SACCADE_VIRTUAL_DEVICE", "synthetic:table?size=160x120", 1);
  const ProgramResult python = run_program(
      "env", {"PYTHONPATH=" + installed("lib/python3/dist-packages"), "PYTHONDONTWRITEBYTECODE=1",
              SACCADE_PYTHON, "-c",
              "import saccade\n"
              "frame = next(saccade.open('" SACCADE_PYTHON_SOURCE "'))\n"
              "print(saccade.__version__, len(saccade.Saliency(fixations=3).compute(frame).fixations))"});
  EXPECT_EQ(python.out, std::string(kVersion) + " 3\n") << python.err;
#endif
}

void DebianTest::check_pages_and_completion() const {
  const std::string help = saccade({"--help"}).out;
  const std::string commands = help.substr(help.find("Subcommands:\n") + 13);
  const std::string completion = text("root/usr/share/bash-completion/completions/saccade");
  const std::string zsh = text("root/usr/share/zsh/vendor-completions/_saccade");
  static const std::regex name("(^|\n)  ([a-z]+) ");
  std::size_t count = 0;
  for (std::sregex_iterator command(commands.begin(), commands.end(), name), end; command != end; ++command) {
    ++count;
    const std::string word = (*command)[2];
    const std::string page = installed("share/man/man1/saccade-" + word + ".1.gz");
    EXPECT_TRUE(fs::exists(page)) << page;
    EXPECT_THAT(completion, HasSubstr("'" + word + "') words="));
    EXPECT_THAT(zsh, HasSubstr("'" + word + ":"));
    if (!have("man")) continue;
    const ProgramResult warnings = run_program(
        "sh", {"-c", "LC_ALL=C.UTF-8 MANROFFSEQ= man --warnings -l -Tutf8 " + page + " >/dev/null"});
    EXPECT_EQ(warnings.err, "") << page;
  }
  EXPECT_GE(count, 9U);
}

TEST_F(DebianTest, BashCompletesCommandsOptionsAndValues) {
  const auto complete = [&](const std::string& words, const std::string& current, const std::string& before) {
    return run_program("bash", {"-c", "source " BUILD_FOLDER "/manual/bash-completion/completions/saccade; "
                                      "COMP_WORDS=(" +
                                          words +
                                          "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                                          "_saccade saccade '" +
                                          current + "' '" + before +
                                          "'; "
                                          "echo ${COMPREPLY[*]}"})
        .out;
  };
  EXPECT_EQ(complete("saccade re", "re", "saccade"), "record\n");
  EXPECT_EQ(complete("saccade oni re", "re", "oni"), "repair\n");
  EXPECT_EQ(complete("saccade run --kern", "--kern", "run"), "--kernel\n");
  EXPECT_EQ(complete("saccade run --model sym", "sym", "--model"), "symmetry3d symmetry2d\n");
  EXPECT_EQ(complete("saccade oni check --js", "--js", "check"), "--json\n");
  write_file(in("mine.toml"), std::string_view(""));
  EXPECT_EQ(complete("saccade run --config " + in("mi"), in("mi"), "--config"), in("mine.toml") + "\n");
}

TEST_F(DebianTest, ZshAcceptsItsCompletion) {
  SKIP_WITHOUT("zsh");
  EXPECT_EQ(run_program("zsh", {"-n", BUILD_FOLDER "/manual/zsh/vendor-completions/_saccade"}).status, 0);
}

#ifdef SACCADE_HAS_VIEWER
TEST_F(DebianTest, TheDesktopAcceptsItsFiles) {
  const std::string desktop = in_source("src/app/desktop/saccade.desktop");
  const std::string metainfo = BUILD_FOLDER "/package/io.github.saccade.metainfo.xml";
  SKIP_WITHOUT("desktop-file-validate");
  const ProgramResult valid = run_program("desktop-file-validate", {desktop});
  EXPECT_EQ(valid.status, 0) << valid.out << valid.err;
  SKIP_WITHOUT("appstreamcli");
  const ProgramResult stream = run_program("appstreamcli", {"validate", "--no-net", metainfo});
  EXPECT_EQ(stream.status, 0) << stream.out << stream.err;
}
#endif

// What a user reads of the installed program names no file of the source tree.
TEST_F(DebianTest, NoTextSpeaksOfTheSourceTree) {
  const ProgramResult strings =
      run_program("sh", {"-c", "grep -aoE '[ `]\\./run[ `a-z-]*|config/(default|paper)\\.toml' " +
                                   saccade_program() + " " BUILD_FOLDER "/manual/man/man1/*"});
  EXPECT_EQ(strings.out, "");
}

}  // namespace
}  // namespace saccade
