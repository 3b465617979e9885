#include "core/file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
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

TEST_F(FileTest, SymbolicLinksAreNotFollowed) {
  write_file(folder_ / "other", std::string_view("precious"));
  fs::create_symlink(folder_ / "other", folder_ / "a.part");
  write_file(folder_ / "a", std::string_view("new"));
  EXPECT_EQ(content(folder_ / "a"), "new");
  fs::create_symlink(folder_ / "other", folder_ / "b");
  write_file(folder_ / "b", std::string_view("new"));
  EXPECT_FALSE(fs::is_symlink(folder_ / "b")) << "the link is replaced";
  for (const char* target : {"other", "absent"}) {
    fs::create_symlink(folder_ / target, folder_ / "l");
    EXPECT_THROW(LineFile(folder_ / "l"), Error);
    EXPECT_THROW(LineFile(folder_ / "l", LineFile::Existing::keep), Error);
    fs::remove(folder_ / "l");
  }
  EXPECT_EQ(content(folder_ / "other"), "precious");
  EXPECT_FALSE(fs::exists(folder_ / "absent"));
}

TEST_F(FileTest, PipesAreRefusedWithoutWaiting) {
  ASSERT_EQ(::mkfifo((folder_ / "p").c_str(), 0600), 0);
  EXPECT_THROW(write_file(folder_ / "p", std::string_view("x")), Error);
  EXPECT_THROW(LineFile(folder_ / "p"), Error);
  try {
    (void)read_file(folder_ / "p");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("a pipe, socket or device instead of a file"));
  }
  const int reader = ::open((folder_ / "p").c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_THROW(LineFile(folder_ / "p"), Error);
  ::close(reader);
}

// While it lives, files of more than ten bytes are an error, like a full disk.
class TenBytesAFile {
 public:
  TenBytesAFile() {
    std::signal(SIGXFSZ, SIG_IGN);
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit small{10, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  }
  ~TenBytesAFile() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  TenBytesAFile(const TenBytesAFile&) = delete;
  TenBytesAFile& operator=(const TenBytesAFile&) = delete;

 private:
  rlimit before_{};
};

TEST_F(FileTest, ALineThatDoesNotFitLeavesNoPartOfItself) {
  LineFile(folder_ / "kept").append("one");
  for (const auto existing : {LineFile::Existing::replace, LineFile::Existing::keep}) {
    const fs::path path = folder_ / (existing == LineFile::Existing::keep ? "kept" : "new");
    LineFile lines(path, existing);
    if (existing == LineFile::Existing::replace) lines.append("one");
    {
      const TenBytesAFile limit;
      EXPECT_THROW(lines.append("a line of more than ten bytes"), Error);
    }
    EXPECT_EQ(content(path), "one\n");
    lines.append("two");
    EXPECT_EQ(content(path), "one\ntwo\n");
  }
}

TEST_F(FileTest, AFileThatDoesNotFitLeavesTheOneBeforeAndNothingBeside) {
  write_file(folder_ / "a", std::string_view("before"));
  {
    const TenBytesAFile limit;
    EXPECT_THROW(write_file(folder_ / "a", std::string_view("more than ten bytes")), Error);
  }
  EXPECT_EQ(content(folder_ / "a"), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, AFileThatIsDeletedMeanwhileIsAnError) {
  LineFile lines(folder_ / "l");
  lines.append("one");
  EXPECT_NO_THROW(lines.check_in_place());
  fs::remove(folder_ / "l");
  EXPECT_THROW(lines.check_in_place(), Error);
  EXPECT_THROW(lines.append("two"), Error);
}

TEST_F(FileTest, MissingAndTooLargeFilesAreUnreadable) {
  EXPECT_THROW((void)read_file(folder_ / "none"), Error);
  write_file(folder_ / "a", std::string_view("12345"));
  EXPECT_THROW((void)read_file(folder_ / "a", 4), Error);
}

TEST_F(FileTest, TheNullDeviceIsEmptyAndOtherDevicesAreRefused) {
  EXPECT_TRUE(read_file("/dev/null").empty());
  fs::create_symlink("/dev/null", folder_ / "link");
  EXPECT_TRUE(read_file(folder_ / "link").empty());
  EXPECT_THROW((void)read_file("/dev/zero"), Error);
}

TEST(Megabytes, GigabytesFromOneOn) {
  EXPECT_EQ(megabytes(12'340'000), "12.3 MB");
  EXPECT_EQ(megabytes(4.56e9), "4.56 GB");
}

}  // namespace
}  // namespace saccade
