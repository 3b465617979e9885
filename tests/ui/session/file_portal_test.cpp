#include "ui/session/file_portal.hpp"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/support/folder_test.hpp"
#include "tests/ui/support/fake_desktop.hpp"
#include "tests/ui/support/x_server.hpp"

namespace saccade {
namespace {

using End = FakeDesktop::End;

class FilePortalTest : public FolderTest {
 protected:
  void SetUp() override {
    if (!is_installed("dbus-daemon")) GTEST_SKIP() << "dbus-daemon is not installed";
    ASSERT_TRUE(desktop_.start(folder_));
    ::setenv("DBUS_SESSION_BUS_ADDRESS", desktop_.address().c_str(), 1);
  }

  static bool until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  // Shows a dialog and waits for its end; returns the error.
  std::string show(FilePortal& portal, const FileDialog& dialog) {
    EXPECT_TRUE(until([&] { return portal.available(); }));
    chosen_.clear();
    portal.show(dialog, [this](const std::string& path) { chosen_ = path; });
    EXPECT_TRUE(portal.busy());
    std::string error;
    EXPECT_TRUE(until([&] {
      error = portal.poll();
      return !portal.busy();
    }));
    return error;
  }

  FakeDesktop desktop_;
  std::string chosen_;
};

TEST_F(FilePortalTest, PassesOnWhatTheUserChooses) {
  FilePortal portal([] {});
  desktop_.answer(End::chosen, "file:///data/a%20b.oni");
  EXPECT_EQ(show(portal, {FileDialog::Kind::open_file, "Open", "/data", "", "x11:2a"}), "");
  EXPECT_EQ(chosen_, "/data/a b.oni");
  EXPECT_EQ(show(portal, {FileDialog::Kind::open_folder, "Folder", "", "", ""}), "");
  EXPECT_EQ(show(portal, {FileDialog::Kind::save_file, "Save", "/tmp", "b.toml", ""}), "");
  const auto shown = desktop_.shown();
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_EQ(shown[0].method, "OpenFile");
  EXPECT_EQ(shown[0].title, "Open");
  EXPECT_EQ(shown[0].parent, "x11:2a");
  EXPECT_EQ(shown[0].folder, "/data");
  EXPECT_FALSE(shown[0].directory);
  EXPECT_TRUE(shown[1].directory);
  EXPECT_EQ(shown[2].method, "SaveFile");
  EXPECT_EQ(shown[2].name, "b.toml");
}

TEST_F(FilePortalTest, ACancelledDialogIsNoErrorAndARefusedOneIs) {
  FilePortal portal([] {});
  desktop_.answer(End::cancelled);
  EXPECT_EQ(show(portal, {}), "");
  EXPECT_EQ(chosen_, "");
  desktop_.answer(End::refused);
  EXPECT_EQ(show(portal, {}), "The desktop's file dialog failed: no screen");
  desktop_.answer(End::chosen, "smb://server/a.oni");
  EXPECT_NE(show(portal, {}).find("smb://server/a.oni"), std::string::npos);
  EXPECT_EQ(chosen_, "");
}

TEST_F(FilePortalTest, WithoutABusThereIsNone) {
  ::setenv("DBUS_SESSION_BUS_ADDRESS", ("unix:path=" + (folder_ / "none").string()).c_str(), 1);
  FilePortal portal([] {});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(portal.available());
  portal.show({}, [](const std::string&) {});
  EXPECT_FALSE(portal.busy());
}

TEST_F(FilePortalTest, WhenTheBusEndsTheDialogEnds) {
  FilePortal portal([] {});
  ASSERT_TRUE(until([&] { return portal.available(); }));
  desktop_.answer(End::never);
  portal.show({}, [](const std::string&) {});
  ASSERT_TRUE(until([&] { return desktop_.shown().size() == 1; }));
  EXPECT_EQ(portal.poll(), "");
  EXPECT_TRUE(portal.busy());
  desktop_.stop();
  std::string error;
  EXPECT_TRUE(until([&] {
    error = portal.poll();
    return !portal.busy();
  }));
  EXPECT_NE(error, "");
  EXPECT_FALSE(portal.available());
}

TEST_F(FilePortalTest, ADialogThatIsNeverAnsweredKeepsNobodyWaiting) {
  const auto begin = std::chrono::steady_clock::now();
  {
    FilePortal portal([] {});
    ASSERT_TRUE(until([&] { return portal.available(); }));
    desktop_.answer(End::never);
    portal.show({}, [](const std::string&) {});
    ASSERT_TRUE(until([&] { return desktop_.shown().size() == 1; }));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << "shorter than D-Bus waits";
}

}  // namespace
}  // namespace saccade
