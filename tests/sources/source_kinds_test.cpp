// The table of sources: which row an input belongs to, and what reads from the table.
#include "sources/source_kind.hpp"

#include <sys/stat.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "sources/open_source.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SourceKinds : public FolderTest {
 protected:
  std::string put(const std::string& name, std::string_view text = "") const {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    write_file(path, text);
    return path.string();
  }
  std::string folder(const std::string& name) const { return (folder_ / name).string(); }
};

std::string kind(const std::string& uri) {
  const SourceKind* found = kind_of(SourceInput(uri));
  return found == nullptr ? "none" : std::string(found->name);
}

std::string complaint(const std::string& uri, ExitStatus status, const InputSettings& settings = {}) {
  try {
    open_source(uri, {{}, settings});
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    return error.what();
  }
  ADD_FAILURE() << uri << " was opened";
  return "";
}

TEST_F(SourceKinds, EveryRowIsComplete) {
  std::set<std::string_view> names;
  for (const SourceKind* row : source_kinds()) {
    EXPECT_TRUE(names.insert(row->name).second) << row->name;
    for (const std::string_view text : {row->name, row->written, row->help, row->recognised_by}) {
      EXPECT_FALSE(text.empty()) << row->name;
      EXPECT_EQ(text.find_first_of("\n|"), std::string_view::npos) << text;
    }
    EXPECT_TRUE(row->recognises != nullptr || !row->endings.empty()) << row->name;
    EXPECT_NE(row->open, nullptr) << row->name;
    for (const std::string_view ending : row->endings)
      EXPECT_EQ(ending, ending_of("a" + std::string(ending)));
  }
}

TEST_F(SourceKinds, TheFormOfTheTextDecides) {
  EXPECT_EQ(kind("openni2"), "openni2");
  EXPECT_EQ(kind("openni2:freenect://0"), "openni2");
  EXPECT_EQ(kind("openni2x"), "none");
  EXPECT_EQ(kind("synthetic:nonsense"), "synthetic");
  EXPECT_EQ(kind("v4l2:/dev/video0"), "v4l2");
  for (const char* text : {"depth_%04d.png", "x/y_%d.png", "%06d.png"})
    EXPECT_EQ(kind(text), "images") << text;
  for (const char* text : {"depth.png", "a%%d.png", "%s.png", "%d_%d.png", "%04d.oni", "%4000x.png"})
    EXPECT_EQ(kind(text), "none") << text;
}

TEST_F(SourceKinds, TheEndingOfAFileDecidesInAnyCase) {
  EXPECT_EQ(kind(put("a.oni")), "oni");
  EXPECT_EQ(kind(put("A.ONI")), "oni");
  EXPECT_EQ(kind(put("a.mat")), "nyu");
  EXPECT_EQ(kind(put("b.PNG")), "images");
  for (const char* name : {"a.pcd", "b.PLY"}) EXPECT_EQ(kind(put(name)), "clouds") << name;
  for (const char* name : {"a.bag", "b.MCAP", "c.db3"}) EXPECT_EQ(kind(put(name)), "bag") << name;
  for (const char* name : {"a.mkv", "b/c.MP4", "d.nut", "e.avi"}) EXPECT_EQ(kind(put(name)), "video") << name;
  for (const char* name : {"b.txt", "mkv", "c", ".oni"}) EXPECT_EQ(kind(put(name)), "none") << name;
  EXPECT_EQ(kind(folder("absent.oni")), "none");
}

TEST_F(SourceKinds, TheContentDecidesWhereTheEndingDoesNot) {
  EXPECT_EQ(kind(put("recording.bin", "NI10 and so on")), "oni");
  EXPECT_EQ(kind(put("notes.txt", "NI1")), "none");
}

TEST_F(SourceKinds, TheFilesInAFolderDecide) {
  put("numbered/12_depth.png");
  put("tum/depth.txt");
  put("osd/depth/a.png");
  put("osd/annotation/a.png");
  put("other/depth/a.png");
  EXPECT_EQ(kind(folder("numbered")), "folder");
  EXPECT_EQ(kind(folder("tum")), "tum");
  EXPECT_EQ(kind(folder("osd")), "osd");
  EXPECT_EQ(kind(folder("other")), "none");
  put("NUMBERED/12_DEPTH.PNG");
  put("paired/depth/a.png");
  put("paired/color/a.jpg");
  put("bop/depth/000000.png");
  put("bop/rgb/000000.png");
  put("bop/scene_camera.json");
  put("scenes/frame-000000.depth.png");
  put("ycb/000001-depth.png");
  put("clouds/0.pcd");
  put("ros/metadata.yaml");
  put("ros/a_0.mcap");
  EXPECT_EQ(kind(folder("NUMBERED")), "folder");
  EXPECT_EQ(kind(folder("paired")), "paired");
  EXPECT_EQ(kind(folder("bop")), "bop");
  for (const char* name : {"scenes", "ycb"}) EXPECT_EQ(kind(folder(name)), "suffix") << name;
  EXPECT_EQ(kind(folder("clouds")), "clouds");
  EXPECT_EQ(kind(folder("ros")), "bag");
}

TEST_F(SourceKinds, ErrorsSayWhatIsExpected) {
  EXPECT_THAT(complaint("nowhere", ExitStatus::unreadable),
              AllOf(HasSubstr("no such source: nowhere"), HasSubstr("FILE.oni"), HasSubstr("openni2[:URI]")));
  EXPECT_THAT(complaint(folder("absent.oni"), ExitStatus::unreadable),
              AllOf(HasSubstr("no such source"), HasSubstr("check the path")));
  EXPECT_THAT(
      complaint(put("notes.txt", "text"), ExitStatus::unreadable),
      AllOf(HasSubstr("not a kind of file that can be read"), HasSubstr(".oni .bag .mcap .db3 .mat .mkv")));
  put("empty/notes.txt");
  EXPECT_THAT(complaint(folder("empty"), ExitStatus::unreadable),
              AllOf(HasSubstr("no frames in the folder"), HasSubstr("NNNN_depth.png"), HasSubstr("depth.txt"),
                    Not(HasSubstr(".mkv"))));
}

TEST_F(SourceKinds, SpecialFilesAndVeryLongNamesAreRefused) {
  for (const char* name : {"x_depth.mkv", "x.oni", "x.mat", "x"}) {
    ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
    EXPECT_THAT(complaint(folder(name), ExitStatus::unreadable), HasSubstr("not a regular file")) << name;
  }
  EXPECT_THAT(complaint("/dev/null", ExitStatus::unreadable), HasSubstr("not a regular file"));
  for (const char* end : {"", ".png", "%04d.png", ".oni", "/"})
    complaint(std::string(30'000, 'x') + end, ExitStatus::unreadable);
  complaint(std::string(30'000, '%') + "d.png", ExitStatus::unreadable);
}

TEST_F(SourceKinds, DevicesAreKnown) {
  EXPECT_TRUE(names_device("openni2"));
  EXPECT_TRUE(names_device("openni2:anything"));
  EXPECT_TRUE(names_device("v4l2:/dev/video0"));
  for (const std::string& uri : {put("a.oni"), folder("absent.oni"), std::string("synthetic:room")})
    EXPECT_FALSE(names_device(uri)) << uri;
}

// A setting that is ignored without a word gives wrong lengths.
TEST_F(SourceKinds, SettingsWithoutEffectAreRefused) {
  put("a/0_depth.png", "");
  for (const char* uri : {"openni2", "v4l2:/dev/video0", "synthetic:table"}) {
    EXPECT_THAT(complaint(uri, ExitStatus::usage, {.depth_unit_mm = 0.1}),
                HasSubstr("--depth-unit has no effect"))
        << uri;
    EXPECT_THAT(complaint(uri, ExitStatus::usage, {.colour_topic = "/a"}),
                HasSubstr("--topics has no effect"));
  }
  EXPECT_THAT(complaint(folder("a"), ExitStatus::usage, {.camera_topic = "/a"}),
              HasSubstr("--topics has no effect"));
  EXPECT_THAT(complaint(folder("a"), ExitStatus::unreadable, {.depth_unit_mm = 0.1}),
              HasSubstr("no usable depth"));
}

TEST_F(SourceKinds, ListsOfFilesKnowTheEndings) {
  for (const char* name : {"a.oni", "b.MAT", "c.mkv"}) EXPECT_TRUE(has_source_ending(name)) << name;
  for (const char* name : {"a.png", "oni", ""}) EXPECT_FALSE(has_source_ending(name)) << name;
}

TEST_F(SourceKinds, TheHelpHasALineForEach) {
  const std::string help = source_help();
  for (const SourceKind* row : source_kinds()) {
    EXPECT_THAT(help, HasSubstr("\n  " + std::string(row->written) + " "));
    EXPECT_THAT(help, HasSubstr(" " + std::string(row->help)));
    EXPECT_EQ(help.find(std::string(row->help) + " (not in this build)") != std::string::npos, !row->built);
  }
}

// The table of README.md, made from the rows.
std::string table() {
  std::string text = "| SOURCE | kind | what is read | recognised by |\n|---|---|---|---|\n";
  for (const SourceKind* row : source_kinds())
    text += "| `" + std::string(row->written) + "` | `" + std::string(row->name) + "` | " +
            std::string(row->help) + " | " + std::string(row->recognised_by) + " |\n";
  return text;
}

// The table that stands there.
std::string table_of_readme() {
  std::ifstream file(in_source("src/sources/README.md"));
  std::string text;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| SOURCE") || (!text.empty() && line.starts_with('|'))) text += line + "\n";
    if (line.empty() && !text.empty()) break;
  }
  return text;
}

TEST_F(SourceKinds, TheReadmeHasTheTable) { EXPECT_EQ(table_of_readme(), table()); }

TEST_F(SourceKinds, APartThatThisBuildLeavesOutIsNamed) {
  for (const SourceKind* row : source_kinds()) {
    if (row->built) continue;
    const std::string uri =
        row->endings.empty() ? std::string(row->name) : put("a" + std::string(row->endings[0]));
    EXPECT_THAT(complaint(uri, ExitStatus::usage), AllOf(HasSubstr("this build has no"), HasSubstr("=OFF")));
  }
}

}  // namespace
}  // namespace saccade
