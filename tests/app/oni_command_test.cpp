#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class OniCommandTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    ASSERT_EQ(run_saccade({"record", "synthetic:cube?size=64x48&noise=kinect", in("a.oni"), "--frames", "12"})
                  .status,
              0);
  }
  void cut(const std::string& to, std::size_t bytes) const {
    const auto all = read_file(in("a.oni"));
    write_file(in(to), std::span(all).first(all.size() - bytes));
  }
};

TEST_F(OniCommandTest, InfoTellsTheStreams) {
  const ProgramResult outcome = run_saccade({"oni", "info", in("a.oni"), "--json"});
  ASSERT_EQ(outcome.status, 0);
  const json streams = json::parse(outcome.out)["streams"];
  ASSERT_EQ(streams.size(), 2u);
  EXPECT_EQ(streams[0]["type"], "depth");
  EXPECT_EQ(streams[0]["codec"], "16zT");
  EXPECT_EQ(streams[0]["width"], 64);
  EXPECT_EQ(streams[0]["height"], 48);
  EXPECT_EQ(streams[0]["frames"], 12);
  EXPECT_EQ(streams[0]["gaps"], 0);
  EXPECT_NEAR(streams[0]["measured_rate_hz"].get<double>(), 30, 0.01);
  EXPECT_NEAR(streams[0]["intrinsics"]["fx"].get<double>(), 52.5, 1e-9);
  EXPECT_EQ(streams[1]["codec"], "JPEG");
  const ProgramResult text = run_saccade({"oni", "info", in("a.oni")});
  EXPECT_THAT(text.out, HasSubstr("depth  16zT 64 x 48"));
}

TEST_F(OniCommandTest, CheckGivesPositionsAndItsStatus) {
  EXPECT_EQ(run_saccade({"oni", "check", in("a.oni")}).status, 0);
  cut("cut.oni", 2000);
  const ProgramResult outcome = run_saccade({"oni", "check", in("cut.oni"), "--json"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(outcome.one_error_line());
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result["sound"], false);
  ASSERT_FALSE(result["problems"].empty());
  for (const json& problem : result["problems"]) {
    EXPECT_TRUE(problem["position"].is_number_unsigned());
    EXPECT_FALSE(problem["meaning"].get<std::string>().empty());
  }
}

TEST_F(OniCommandTest, RepairMakesASoundFileBesideTheOriginal) {
  cut("cut.oni", 2000);
  const auto before = read_file(in("cut.oni"));
  const ProgramResult outcome = run_saccade({"oni", "repair", in("cut.oni"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["repaired"], in("cut.repaired.oni"));
  EXPECT_EQ(run_saccade({"oni", "check", in("cut.repaired.oni")}).status, 0);
  EXPECT_EQ(read_file(in("cut.oni")), before);
  EXPECT_EQ(run_saccade({"oni", "repair", in("cut.oni")}).status, 2) << "the file exists";
  EXPECT_EQ(run_saccade({"oni", "repair", in("cut.oni"), in("other.oni")}).status, 0);
  EXPECT_EQ(run_saccade({"oni", "repair", in("cut.oni"), "--out", in("third.oni")}).status, 0);
  EXPECT_EQ(run_saccade({"oni", "repair", in("cut.oni"), in("cut.oni"), "--force"}).status, 2);
}

TEST_F(OniCommandTest, WhatIsNoRecordingIsOneLineAndStatus3) {
  write_file(in("text.oni"), std::string_view("not a recording, but long enough to be one"));
  for (const std::string command : {"info", "check", "repair"})
    for (const std::string& file : {in("text.oni"), in("absent.oni"), folder_.string()}) {
      const ProgramResult outcome = run_saccade({"oni", command, file});
      EXPECT_EQ(outcome.status, 3) << command << " " << file;
      EXPECT_TRUE(outcome.one_error_line());
    }
  EXPECT_EQ(run_saccade({"oni"}).status, 2);
  EXPECT_EQ(run_saccade({"oni", "guess", in("a.oni")}).status, 2);
}

}  // namespace
}  // namespace saccade
