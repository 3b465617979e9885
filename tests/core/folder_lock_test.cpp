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

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

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
}

TEST_F(FolderLockTest, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(FolderLock(folder_ / "none", "x"), Error);
}

}  // namespace
}  // namespace saccade
