#include "core/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file_writer.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/system_calls.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FileTest : public FolderTest {
 protected:
  FileTest() { std::signal(SIGXFSZ, SIG_IGN); }  // as the program does
};

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
  EXPECT_THAT(error_of(ExitStatus::failed, [&] { write_file(folder_ / "a", std::string_view("one")); }),
              AllOf(HasSubstr("No space left"), HasSubstr((folder_ / "a").string())));
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
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_file(folder_ / "p"); }),
              StartsWith("a pipe, socket or device instead of a file"));
  const int reader = ::open((folder_ / "p").c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_THROW(LineFile(folder_ / "p"), Error);
  ::close(reader);
}

TEST_F(FileTest, ALineThatDoesNotFitLeavesNoPartOfItself) {
  LineFile(folder_ / "kept").append("one");
  for (const auto existing : {LineFile::Existing::replace, LineFile::Existing::keep}) {
    const fs::path path = folder_ / (existing == LineFile::Existing::keep ? "kept" : "new");
    LineFile lines(path, existing);
    if (existing == LineFile::Existing::replace) lines.append("one");
    {
      const FileSizeLimit limit(10);
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
    const FileSizeLimit limit(10);
    EXPECT_THROW(write_file(folder_ / "a", std::string_view("more than ten bytes")), Error);
  }
  EXPECT_EQ(content(folder_ / "a"), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, AFileThatCannotGetItsNameLeavesNothingBeside) {
  FileWriter file(folder_ / "a");
  file.write("text");
  fs::create_directory(folder_ / "a");  // meanwhile
  EXPECT_THROW(file.finish(), Error);
  EXPECT_TRUE(fs::is_directory(folder_ / "a"));
  EXPECT_FALSE(fs::exists(folder_ / "a.part"));
}

// As network file systems do, and signals.
TEST_F(FileTest, WritesThatAreInterruptedOrTakeAPartGoOn) {
  SystemCalls calls;
  int count = 0;
  calls.write = [&](int file, const void* bytes, std::size_t size) -> ssize_t {
    if (++count % 2 == 0) return SystemCalls::real_write(file, bytes, std::min<std::size_t>(size, 3));
    errno = EINTR;
    return -1;
  };
  write_file(folder_ / "a", std::string_view("one two three"));
  LineFile(folder_ / "l").append("four five");
  EXPECT_EQ(count, 2 * (5 + 4)) << "every call stood in";
  EXPECT_EQ(content(folder_ / "a"), "one two three");
  EXPECT_EQ(content(folder_ / "l"), "four five\n");
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
