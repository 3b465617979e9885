#include "core/file.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;

class FileTest : public FolderTest {};

std::string content(const fs::path& path) {
  const auto bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

TEST_F(FileTest, ReplacesFilesAndLeavesNoTemporaryFile) {
  write_file(folder_ / "a", std::string_view("one"));
  write_file(folder_ / "a", std::string_view("two"));
  EXPECT_EQ(content(folder_ / "a"), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, FullDiskIsAnErrorThatNamesTheFile) {
  fs::create_symlink("/dev/full", folder_ / "a");
  try {
    write_file(folder_ / "a", std::string_view("one"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::failed);
    EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find((folder_ / "a").string()), std::string::npos);
  }
  LineFile lines(folder_ / "a");
  EXPECT_THROW(lines.append("x"), Error);
}

TEST_F(FileTest, AppendedLinesCanBeReadAtOnce) {
  LineFile lines(folder_ / "l");
  lines.append("one");
  EXPECT_EQ(content(folder_ / "l"), "one\n");
  lines.append("two");
  EXPECT_EQ(content(folder_ / "l"), "one\ntwo\n");
}

TEST_F(FileTest, LinesAreAppendedToAKeptFile) {
  LineFile(folder_ / "l").append("one");
  LineFile(folder_ / "l", LineFile::Existing::keep).append("two");
  EXPECT_EQ(content(folder_ / "l"), "one\ntwo\n");
  LineFile(folder_ / "l").append("three");
  EXPECT_EQ(content(folder_ / "l"), "three\n");
}

TEST_F(FileTest, MissingAndTooLargeFilesAreUnreadable) {
  EXPECT_THROW((void)read_file(folder_ / "none"), Error);
  write_file(folder_ / "a", std::string_view("12345"));
  EXPECT_THROW((void)read_file(folder_ / "a", 4), Error);
}

TEST(Megabytes, GigabytesFromOneOn) {
  EXPECT_EQ(megabytes(12'340'000), "12.3 MB");
  EXPECT_EQ(megabytes(4.56e9), "4.56 GB");
}

}  // namespace
}  // namespace saccade
