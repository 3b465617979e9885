#include "ui/session/folder_listing.hpp"

#include <unistd.h>

#include <filesystem>
#include <thread>

#include <gmock/gmock.h>

#include "core/file.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using Entry = FolderContents::Entry;
using ::testing::ElementsAre;

class FolderListingTest : public FolderTest {
 protected:
  FolderListingTest() {
    fs::create_directories(folder_ / "stills");
    fs::create_directories(folder_ / "other");
    write_file(folder_ / "stills/0000_depth.png", "x");
    for (const char* name : {"b.oni", "a.mp4", "notes.txt", ".hidden.oni"}) write_file(folder_ / name, "x");
  }
};

TEST_F(FolderListingTest, ShowsWhatCanBeEnteredAndWhatCanBeOpened) {
  const FolderContents contents = list_folder(folder_.string());
  EXPECT_EQ(contents.error, "");
  EXPECT_EQ(contents.folder, folder_.string());
  EXPECT_EQ(contents.parent, folder_.parent_path().string());
  EXPECT_FALSE(contents.source);
  EXPECT_THAT(contents.entries, ElementsAre(Entry{"other", true, false}, Entry{"stills", true, true},
                                            Entry{"a.mp4", false, true}, Entry{"b.oni", false, true}));
  EXPECT_TRUE(list_folder((folder_ / "stills").string()).source);
}

TEST_F(FolderListingTest, ANameThatIsWrongShowsTheFolderAboveIt) {
  for (const char* name : {"no/such.oni", "b.oni", ""})
    EXPECT_EQ(list_folder((folder_ / name).string()).folder, folder_.string()) << name;
  EXPECT_EQ(list_folder("/").parent, "");
  EXPECT_EQ(list_folder("").folder, fs::current_path().string());
}

TEST_F(FolderListingTest, WhatCannotBeReadIsAnErrorAndNoException) {
  EXPECT_EQ(list_folder((folder_ / std::string(5000, 'x')).string()).folder, folder_.string());
  fs::permissions(folder_ / "other", fs::perms::none);
  const FolderContents closed = list_folder((folder_ / "other").string());
  EXPECT_EQ(closed.error.empty(), ::geteuid() == 0) << "root may read everything";
  EXPECT_TRUE(closed.entries.empty());
  fs::permissions(folder_ / "other", fs::perms::owner_all);
}

TEST_F(FolderListingTest, TheListerFollowsTheText) {
  FolderLister lister([] {});
  const auto shows = [&](const fs::path& folder) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (lister.poll(folder.string()).folder != folder.string()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  };
  EXPECT_TRUE(shows(folder_));
  EXPECT_TRUE(shows(folder_ / "stills"));
}

}  // namespace
}  // namespace saccade
