// Driver modules of other makers, by SACCADE_OPENNI2_DRIVERS. The maker's module is ours for the virtual
// device under a foreign name, in an installation of OpenNI2 that does not have ours.
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class OtherMakersTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    const fs::path drivers = "openni2/OpenNI2/Drivers", ours = fs::path(saccade_program()).parent_path();
    fs::create_directories(folder_ / drivers);
    fs::create_symlink(ours / "openni2/libOpenNI2.so.0", folder_ / "openni2/libOpenNI2.so.0");
    for (const auto& entry : fs::directory_iterator(ours / drivers))
      if (entry.path().filename() != "libSaccadeVirtual.so.0")
        fs::create_symlink(entry.path(), folder_ / drivers / entry.path().filename());
    fs::create_directory(folder_ / "acme");
    fs::copy(ours / drivers / "libSaccadeVirtual.so.0", folder_ / "acme/libacme.so");
    ::setenv("LD_LIBRARY_PATH", in("openni2").c_str(), 1);
    ::setenv("SACCADE_OPENNI2_DRIVERS", in("acme").c_str(), 1);
    plug_in("");
  }
  ~OtherMakersTest() override {
    for (const char* name : {"LD_LIBRARY_PATH", "SACCADE_OPENNI2_DRIVERS", "SACCADE_VIRTUAL_DEVICE"})
      ::unsetenv(name);
  }

  static void plug_in(const std::string& faults) {
    ::setenv("SACCADE_VIRTUAL_DEVICE", ("synthetic:table?size=160x120&frames=5" + faults).c_str(), 1);
  }

  // "PROBLEM -> REMEDY" of each. That the folder here lacks a module of ours is the first of them.
  static std::vector<std::string> problems(const json& report) {
    std::vector<std::string> texts;
    for (const json& each : report["problems"])
      texts.push_back(each["problem"].get<std::string>() + " -> " + each["remedy"].get<std::string>());
    return texts;
  }

  json doctor() const { return json::parse(run_saccade({"doctor", "--json", "--sysfs", in("sys")}).out); }
};

TEST_F(OtherMakersTest, DevicesAndDoctorShowTheModule) {
  const json devices = json::parse(run_saccade({"devices", "--json"}).out)["devices"];
  ASSERT_EQ(devices.size(), 1U);
  EXPECT_EQ(devices[0]["serial"], "VIRTUAL-1");
  EXPECT_THAT(devices[0]["depth_modes"], Contains("160x120@30"));
  const json modules = doctor()["openni2"]["modules"];
  for (const json& module : modules) {
    EXPECT_EQ(module["problem"], "");
    EXPECT_EQ(module["named"], module["name"] == "acme") << module;
    EXPECT_NE(module["name"], "SaccadeVirtual");
  }
  ::unsetenv("SACCADE_OPENNI2_DRIVERS");
  EXPECT_EQ(json::parse(run_saccade({"devices", "--json"}).out)["devices"].size(), 0U);
}

TEST_F(OtherMakersTest, ItsSensorIsChosenBySerialNumberAndSurvivesALoss) {
  plug_in("&loss_after=8&back_after_ms=50");
  const ProgramResult run = run_saccade(
      {"run", "openni2:serial=VIRTUAL-1", "--frames", "20", "--out", in("out"), "--dump", "none", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary["ledger"]["processed"], 20);
  EXPECT_GE(summary["device"]["losses"], 2);
  const ProgramResult other =
      run_saccade({"run", "openni2:serial=VIRTUAL-2", "--wait", "0.2", "--out", in("other")});
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.err, AllOf(HasSubstr("this sensor is not connected: openni2:serial=VIRTUAL-2"),
                               HasSubstr("saccade devices lists")));
}

TEST_F(OtherMakersTest, DoctorSaysWhyAModuleDoesNotLoad) {
  write_file(in("acme/libbroken.so"), "a text");
  const json report = doctor();
  EXPECT_THAT(problems(report), Contains(AllOf(HasSubstr("the driver module broken"),
                                               HasSubstr("it is not a shared library of Linux"))));
  EXPECT_THAT(problems(report), Not(Contains(HasSubstr("the driver module acme"))));
  EXPECT_EQ(json::parse(run_saccade({"devices", "--json"}).out)["devices"].size(), 1U) << "the other works";
}

TEST_F(OtherMakersTest, DoctorSeesThatOpenNiIniRedirectsTheRepository) {
  fs::create_directories(folder_ / "etc/openni2");
  write_file(in("etc/openni2/OpenNI.ini"),
             "[Device]\n;Override=\"\"\n[Drivers]\nRepository=/opt/acme/drivers\n");
  const json report = doctor();
  EXPECT_EQ(report["openni2"]["driver_folder"], "/opt/acme/drivers");
  EXPECT_THAT(problems(report)[0],
              AllOf(HasSubstr("etc/openni2/OpenNI.ini makes OpenNI2 take"), HasSubstr("/opt/acme/drivers")));
  write_file(in("etc/openni2/OpenNI.ini"), "[Drivers]\n;Repository=/opt/acme/drivers\n");
  EXPECT_EQ(doctor()["openni2"]["redirected_by"], "");
}

TEST_F(OtherMakersTest, AdviceForSensorsWithoutAModuleHere) {
  const auto advice = [&](const std::string& vendor, const std::string& product) {
    fs::create_directories(folder_ / "sys/bus/usb/devices/1-1");
    write_file(in("sys/bus/usb/devices/1-1/idVendor"), vendor);
    write_file(in("sys/bus/usb/devices/1-1/idProduct"), product);
    return problems(doctor());
  };
  EXPECT_THAT(advice("8086", "0b07"),
              Contains(AllOf(HasSubstr("RealSense D435 "), HasSubstr("wrappers/openni2"))));
  EXPECT_THAT(advice("045e", "097c"),
              Contains(AllOf(HasSubstr("Azure"), HasSubstr("no OpenNI2 module for it"))));
  EXPECT_THAT(advice("2bc5", "0401"), Contains(AllOf(HasSubstr("Orbbec Astra "), HasSubstr("liborbbec.so"))));
  EXPECT_THAT(advice("2bc5", "0670"),
              Contains(AllOf(HasSubstr("Orbbec sensor"), HasSubstr("Orbbec's own SDK"))));
}

}  // namespace
}  // namespace saccade
