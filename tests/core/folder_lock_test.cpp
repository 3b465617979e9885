#include "core/folder_lock.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/system_calls.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class FolderLockTest : public FolderTest {
 protected:
  std::string complaint() const {
    try {
      const FolderLock lock(folder_, "the second");
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::failed);
      return error.what();
    }
    return "";
  }
};

TEST_F(FolderLockTest, OneOwnerAtATimeAndTheErrorNamesIt) {
  std::optional<FolderLock> lock(std::in_place, folder_, "the first");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("in use by the first, process " + std::to_string(::getpid())),
                                 HasSubstr(folder_.string())));
  lock.reset();
  EXPECT_TRUE(fs::is_empty(folder_)) << "the file is removed";
  EXPECT_EQ(complaint(), "");
}

TEST_F(FolderLockTest, AKilledOwnerLeavesNoLock) {
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder_, "killed");
    ::_exit(0);  // without a destructor
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_TRUE(fs::exists(folder_ / ".saccade.lock"));
  EXPECT_EQ(complaint(), "");
}

TEST_F(FolderLockTest, TheFileNamesItsOwnerAndNothingElse) {
  write_file(folder_ / ".saccade.lock", std::string(1000, 'x'));  // of one that was killed
  const FolderLock lock(folder_, "the owner");
  const auto bytes = read_file(folder_ / ".saccade.lock");
  EXPECT_THAT(std::string(bytes.begin(), bytes.end()),
              MatchesRegex("the owner, process " + std::to_string(::getpid()) + " on [^\n]+\n"));
}

// The lock of a file that is no longer there keeps nobody out.
TEST_F(FolderLockTest, IfTheOwnerBeforeLeavesInTheMiddleTheFileIsMadeAgain) {
  std::optional<FolderLock> first(std::in_place, folder_, "the first");
  SystemCalls calls;
  calls.before_flock = [&] { first.reset(); };  // the second one has opened the file of the first
  const FolderLock second(folder_, "the second");
  EXPECT_FALSE(first);
  EXPECT_THAT(lock_owner(folder_), HasSubstr("the second"));
}

// Else it could be the file of the next owner.
TEST_F(FolderLockTest, WhenTheFileIsRemovedItIsStillLocked) {
  std::optional<FolderLock> lock(std::in_place, folder_, "the owner");
  SystemCalls calls;
  std::string owner;
  calls.before_unlink = [&] { owner = lock_owner(folder_); };
  lock.reset();
  EXPECT_THAT(owner, HasSubstr("the owner"));
}

// An owner may remove the file between the moments when another one opens and locks it.
TEST_F(FolderLockTest, OwnersThatComeAndGoAreNeverTwoAtOnce) {
  constexpr int kTurns = 400;
  std::atomic<int> owners = 0, most = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (int turns = 0; turns < kTurns;) try {
            const FolderLock lock(folder_, "one of many");
            const int now = ++owners;
            if (now > most) most = now;
            ++turns;
            --owners;
          } catch (const Error&) {
            std::this_thread::yield();  // in use
          }
      });
  }
  EXPECT_EQ(most, 1);
}

TEST_F(FolderLockTest, ASymbolicLinkIsNotFollowed) {
  write_file(folder_ / "other", std::string_view("precious"));
  fs::create_directories(folder_ / "out");
  fs::create_symlink(folder_ / "other", folder_ / "out/.saccade.lock");
  EXPECT_THROW(FolderLock(folder_ / "out", "x"), Error);
  EXPECT_EQ(read_file(folder_ / "other").size(), 8U);
  fs::remove(folder_ / "other");
  fs::create_directories(folder_ / "another");
  fs::remove(folder_ / "out/.saccade.lock");
  fs::create_symlink(folder_ / "another/.saccade.lock", folder_ / "out/.saccade.lock");
  const FolderLock lock(folder_ / "another", "x");
  EXPECT_EQ(lock_owner(folder_ / "out"), "") << "that is the other folder's";
}

TEST_F(FolderLockTest, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(FolderLock(folder_ / "none", "x"), Error);
}

}  // namespace
}  // namespace saccade
