// `saccade doctor` and `saccade devices`, on machines made of folders.
#include "app/doctor.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// The tree of a machine; its sysfs is folder_/sys.
class DoctorTest : public ProgramTest {
 protected:
  ~DoctorTest() override { ::unsetenv("SACCADE_VIRTUAL_DEVICE"); }

  void put(const fs::path& path, const std::string& text) const {
    fs::create_directories((folder_ / path).parent_path());
    write_file(folder_ / path, text);
  }

  void plug_in(const std::string& port, const std::string& id, const std::string& speed, int mode) const {
    const fs::path device = fs::path("sys/bus/usb/devices") / port;
    put(device / "idVendor", id.substr(0, 4) + "\n");
    put(device / "idProduct", id.substr(5) + "\n");
    put(device / "speed", speed + "\n");
    put(device / "busnum", "1\n");
    put(device / "devnum", "7\n");
    put("dev/bus/usb/001/007", "");
    fs::permissions(folder_ / "dev/bus/usb/001/007", fs::perms(mode));
  }

  void add_rule(const std::string& id) const {
    put("lib/udev/rules.d/60-sensors.rules",
        "# SUBSYSTEM==\"usb\", ATTR{idVendor}==\"ffff\", MODE=\"0666\"\nSUBSYSTEM==\"usb\", "
        "ATTR{idProduct}==\"" +
            id.substr(5) + "\", ATTR{idVendor}==\"" + id.substr(0, 4) + "\", MODE:=\"0666\"\n");
  }

  json doctor() const {
    const ProgramResult outcome = run_saccade({"doctor", "--json", "--sysfs", in("sys")});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out);
  }

  static std::string all_problems(const json& report) {
    std::string text;
    for (const json& problem : report["problems"])
      text += problem["problem"].get<std::string>() + " -> " + problem["remedy"].get<std::string>() + "\n";
    return text;
  }
};

TEST_F(DoctorTest, FindsOpenNi2WithTheStockAndOurModules) {
  const json report = doctor();
  EXPECT_THAT(report["openni2"]["version"].get<std::string>(), HasSubstr("2.2"));
  std::vector<std::string> names;
  for (const json& module : report["openni2"]["modules"]) {
    names.push_back(module["name"]);
    EXPECT_EQ(module["problem"], "");
  }
  EXPECT_THAT(names, ::testing::IsSupersetOf(
                         {"PS1080", "PSLink", "SaccadeBridge", "SaccadeFreenect", "SaccadeVirtual"}));
}

TEST_F(DoctorTest, WithoutUsbDevicesTheRemedyIsToPlugOneIn) {
  const json report = doctor();  // there is no sys folder
  EXPECT_EQ(report["usb"].size(), 0U);
  EXPECT_THAT(all_problems(report), HasSubstr("no USB device looks like a sensor -> plug one in"));
  EXPECT_FALSE(report["ok"]);
}

TEST_F(DoctorTest, AKinectWithoutPermissionAndRuleGetsTheRule) {
  plug_in("1-1.2", "045e:02ae", "480", 0600);
  const json report = doctor();
  const json usb = report["usb"].at(0);
  EXPECT_EQ(usb["usb_id"], "045e:02ae");
  EXPECT_EQ(usb["udev_rule"], "");
  EXPECT_EQ(usb["speed_mbps"], 480);
  EXPECT_EQ(usb["permission"], ::geteuid() == 0 ? "root only" : "granted");
  if (::geteuid() != 0) GTEST_SKIP() << "the node is the user's own; only root sees what others may not";
  const std::string problems = all_problems(report);
  EXPECT_THAT(problems,
              HasSubstr("no udev rule names it -> echo 'SUBSYSTEM==\"usb\", ATTR{idVendor}==\"045e\""));
  EXPECT_THAT(problems, HasSubstr("udevadm control --reload"));
}

TEST_F(DoctorTest, AnExistingRuleOnlyNeedsToBeApplied) {
  plug_in("1-1.2", "045e:02ae", "480", 0600);
  add_rule("045e:02ae");
  const json report = doctor();
  EXPECT_THAT(report["usb"].at(0)["udev_rule"].get<std::string>(), HasSubstr("60-sensors.rules"));
  EXPECT_EQ(all_problems(report).find("echo"), std::string::npos);
}

TEST_F(DoctorTest, AKinectWithPermissionIsNoProblemOfItsOwn) {
  plug_in("1-1.2", "045e:02ae", "480", 0666);
  add_rule("045e:02ae");
  const json report = doctor();
  EXPECT_EQ(report["usb"].at(0)["permission"], "granted");
  EXPECT_EQ(report["problems"].size(), 1U);
  EXPECT_THAT(all_problems(report), HasSubstr("OpenNI2 does not list the sensor")) << "it is made of files";
}

TEST_F(DoctorTest, ASlowPortIsNamedWithItsSpeed) {
  plug_in("2-1", "1d27:0601", "12", 0666);
  EXPECT_THAT(all_problems(doctor()), HasSubstr("connected at 12 Mb/s"));
}

TEST_F(DoctorTest, AKinectWithoutPowerShowsItsMotorOnly) {
  plug_in("1-1.1", "045e:02b0", "12", 0666);
  const json report = doctor();
  EXPECT_THAT(all_problems(report), HasSubstr("no power"));
  EXPECT_EQ(report["problems"].size(), 1U) << "it is meant to be that slow";
}

TEST_F(DoctorTest, TheWebcamDriverOfTheKernelIsInTheWay) {
  plug_in("1-1.2", "045e:02ae", "480", 0666);
  const fs::path interface = folder_ / "sys/bus/usb/devices/1-1.2/1-1.2:1.0";
  fs::create_directories(interface);
  fs::create_symlink("../../../drivers/gspca_kinect", interface / "driver");
  EXPECT_THAT(all_problems(doctor()), HasSubstr("sudo modprobe -r gspca_kinect"));
}

TEST_F(DoctorTest, OtherDevicesAndBrokenEntriesAreNoSensors) {
  plug_in("1-3", "046d:c52b", "12", 0600);
  put("sys/bus/usb/devices/1-4/idVendor", "garbage\n");
  put("sys/bus/usb/devices/usb1/idVendor", "1d6b\n");
  EXPECT_EQ(doctor()["usb"].size(), 0U);
}

TEST_F(DoctorTest, ProblemsOfTheInstallationComeFirst) {
  Examination found;
  found.openni2.driver_folder = "/drivers";
  found.openni2.modules = {{"PS1080", "/drivers/libPS1080.so.0", ""},
                           {"PSLink", "/drivers/libPSLink.so.0", "it needs x", "ldd -r"},
                           {"SaccadeBridge", "/drivers/libSaccadeBridge.so.0", ""},
                           {"SaccadeVirtual", "/drivers/libSaccadeVirtual.so.0", ""}};
  const auto problems = diagnose(found);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_THAT(problems[0].what, HasSubstr("SaccadeFreenect is not in /drivers"));
  EXPECT_THAT(problems[1].what, HasSubstr("PSLink (/drivers/libPSLink.so.0) cannot be loaded: it needs x"));
  EXPECT_THAT(problems[2].what, HasSubstr("no USB device"));
}

TEST_F(DoctorTest, PartsThatTheBuildLeavesOutAreNamed) {
  Examination found;
  found.openni2.left_out = {"SaccadeFreenect"};
  found.openni2.modules = {
      {"PS1080", "", ""}, {"PSLink", "", ""}, {"SaccadeBridge", "", ""}, {"SaccadeVirtual", "", ""}};
  plug_in("1-1.2", "045e:02ae", "480", 0666);
  found.usb = find_usb_sensors(folder_ / "sys");
  auto problems = diagnose(found);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].what, HasSubstr("this build has no driver module for it"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("-DSACCADE_FREENECT=ON"));

  found.openni2 = {};
  found.openni2.in_this_build = false;
  found.openni2_error = "this build has no OpenNI2";
  problems = diagnose(found);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].what, "this build has no OpenNI2");
  EXPECT_THAT(problems[0].remedy, HasSubstr("-DSACCADE_OPENNI2=ON"));
}

TEST_F(DoctorTest, DevicesListsTheSensorsOrReportsThatThereAreNone) {
  const ProgramResult none = run_saccade({"devices"});
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_THAT(none.out, HasSubstr("no sensor is connected"));
  EXPECT_EQ(json::parse(run_saccade({"devices", "--json"}).out)["devices"].size(), 0U);
  ::setenv("SACCADE_VIRTUAL_DEVICE", "synthetic:cone?size=64x48", 1);
  const json one = json::parse(run_saccade({"devices", "--json"}).out)["devices"].at(0);
  EXPECT_EQ(one["vendor"], "Saccade");
  EXPECT_EQ(one["driver"], "SaccadeVirtual");
  EXPECT_EQ(one["source"], "openni2:" + one["uri"].get<std::string>());
  EXPECT_THAT(one["depth_modes"], ::testing::Contains("64x48@30"));
}

}  // namespace
}  // namespace saccade
