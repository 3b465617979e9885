#include "eval/result_file.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "eval/evaluator.hpp"
#include "eval/hit_ratio.hpp"
#include "samples.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ResultFileTest : public FolderTest {
 protected:
  void put(const std::string& text) const { write_file(folder_ / kResultFile, text); }
  std::string text() const {
    const auto bytes = read_file(folder_ / kResultFile);
    return {bytes.begin(), bytes.end()};
  }
};

TEST_F(ResultFileTest, WhatIsWrittenIsRead) {
  write_results(folder_, sample_plan(), sample_images());
  const ResultFile file = scan_results(folder_);
  EXPECT_TRUE(file.complete);
  EXPECT_EQ(file.images, 3);
  EXPECT_EQ(file.runs.size(), 1U);
  EXPECT_EQ(plan_line(file.plan), plan_line(sample_plan()));
  const auto again = read_all({file});
  ASSERT_EQ(again.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(image_line(again[i]), image_line(sample_images()[i]));
  EXPECT_EQ(again[0].conditions[1].points[2].label, 5);
  EXPECT_EQ(again[2].name, "a,\"b\"");
}

TEST_F(ResultFileTest, ImagesComeInTheOrderOfTheirFrames) {
  const auto images = sample_images();
  write_results(folder_, sample_plan(), {images[2], images[0], images[1]});
  const ResultFile file = scan_results(folder_);
  EXPECT_EQ(file.runs.size(), 2U);
  const auto again = read_all({file});
  ASSERT_EQ(again.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(image_line(again[i]), image_line(images[i]));
}

// Each time that they begin again costs memory when they are merged.
TEST_F(ResultFileTest, FramesInAnyOrderAreAnError) {
  constexpr int kMostRuns = 10'000;
  std::string lines = plan_line(sample_plan()) + "\n";
  for (int i = 0; i < kMostRuns; ++i)
    lines += "{\"frame\":" + std::to_string(kMostRuns - i) + ",\"name\":\"\",\"left_out\":\"\"}\n";
  put(lines);
  EXPECT_EQ(scan_results(folder_).runs.size(), std::size_t{kMostRuns});
  put(lines + "{\"frame\":0,\"name\":\"\",\"left_out\":\"\"}\n");
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
              HasSubstr("the frames are not in order"));
}

TEST_F(ResultFileTest, AnEndThatIsNotOneIsAnError) {
  write_results(folder_, sample_plan(), {sample_images()[0]});
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
              HasSubstr("the end after 1 images of 3"));
  write_results(folder_, sample_plan(), sample_images());
  LineFile(folder_ / kResultFile, LineFile::Existing::keep).append(end_line());
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
              HasSubstr("lines after its end"));
}

TEST_F(ResultFileTest, VoidIsWrittenAndRead) {
  auto images = sample_images();
  images[0].void_known = true;
  images[0].conditions[0].points[2].label = kVoid;
  write_results(folder_, sample_plan(), images);
  const auto again = read_all({scan_results(folder_)});
  EXPECT_TRUE(again[0].void_known);
  EXPECT_EQ(again[0].conditions[0].points[2].label, kVoid);
  EXPECT_FALSE(again[2].void_known);
}

TEST_F(ResultFileTest, ConfidencesAreWrittenAndRead) {
  auto images = sample_images();
  images[0].conditions[0].points[1].confidence = 0.9342711F;
  write_results(folder_, sample_plan(), images);
  const auto read = read_all({scan_results(folder_)})[0].conditions[0].points;
  EXPECT_EQ(read[1].confidence, 0.9342711F);
  EXPECT_FALSE(read[0].confidence);
}

TEST_F(ResultFileTest, ANewFileHoldsThePlan) {
  const ResumedResults results = resume_results(folder_, sample_plan());
  EXPECT_EQ(results.images, 0);
  EXPECT_FALSE(results.complete);
  EXPECT_EQ(text(), plan_line(sample_plan()) + "\n");
}

TEST_F(ResultFileTest, ACutLastLineIsTakenOff) {
  const std::string whole = plan_line(sample_plan()) + "\n" + image_line(sample_images()[0]) + "\n";
  const std::string cut = image_line(sample_images()[2]);
  for (const std::size_t length : {std::size_t{1}, cut.size() / 2, cut.size()}) {
    put(whole + cut.substr(0, length));
    const ResumedResults results = resume_results(folder_, sample_plan());
    EXPECT_EQ(results.images, 1);
    EXPECT_EQ(results.known, (std::vector<bool>{true, false, false}));
    EXPECT_FALSE(results.complete);
    EXPECT_EQ(text(), whole);
  }
  put(plan_line(sample_plan()).substr(0, 30));
  EXPECT_EQ(resume_results(folder_, sample_plan()).images, 0);
  EXPECT_EQ(text(), plan_line(sample_plan()) + "\n");
}

TEST_F(ResultFileTest, AnotherPlanIsNotGoneOnWith) {
  EXPECT_EQ(resume_results(folder_, sample_plan()).images, 0);
  EvalPlan other = sample_plan();
  other.points = 5;
  EXPECT_THAT(error_of(ExitStatus::usage, [&] { return resume_results(folder_, other); }),
              HasSubstr("points is 3, not 5"));
  other = sample_plan();
  other.settings.last_level = 2;
  EXPECT_THAT(error_of(ExitStatus::usage, [&] { return resume_results(folder_, other); }),
              HasSubstr("levels is \"0..4\", not \"0..2\""));
  EXPECT_EQ(text(), plan_line(sample_plan()) + "\n") << "nothing is lost";
}

TEST_F(ResultFileTest, DamagedFilesAreNamedWithTheLine) {
  const std::string plan = plan_line(sample_plan()) + "\n";
  for (const std::string& bad : {std::string("{\n"), std::string("{}\n"), std::string("[]\n"),
                                 std::string("{\"frame\":0,\"name\":\"\"}\n"), std::string("\xff\xfe\n")}) {
    put(plan + image_line(sample_images()[0]) + "\n" + bad);
    EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
                HasSubstr("results.jsonl:3"));
    put(bad);
    EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
                HasSubstr("results.jsonl:1"));
  }
  ImageResult fewer = sample_images()[0];
  fewer.conditions.pop_back();
  put(plan + image_line(fewer) + "\n");
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
              HasSubstr("numbers of"));
  error_of(ExitStatus::unreadable, [&] { return scan_results(folder_ / "nowhere"); });
}

TEST_F(ResultFileTest, EveryNumberHasARange) {
  const std::string plan = plan_line(sample_plan()), image = image_line(sample_images()[0]);
  std::string many;
  const auto expect_refused = [&](std::string text, const std::string& from, const std::string& to,
                                  int line) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    put(line == 1 ? text + "\n" : plan + "\n" + text + "\n");
    EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return scan_results(folder_); }),
                HasSubstr("results.jsonl:" + std::to_string(line)))
        << to;
  };
  for (const char* bad : {"1e6", "1e17", "-0.1", "null", "\"0.1\""})
    for (const char* key : {"\"random\":[", "\"centre\":["})
      expect_refused(image, key, std::string(key) + bad + ",", 2);
  for (const char* bad : {"-1", "1e300", "0.5", "1000000000000000000", "[]"}) {
    expect_refused(image, "\"frame\":0", std::string("\"frame\":") + bad, 2);
    expect_refused(image, "\"objects\":2", std::string("\"objects\":") + bad, 2);
    expect_refused(image, "[1,2,4]", std::string("[1,") + bad + ",4]", 2);
  }
  expect_refused(image, "[1,2,4]", "[1,2,-2]", 2);
  for (const char* bad : {"-0.1", "1.1", "null"})
    expect_refused(image, "[1,2,4]", std::string("[1,2,4,") + bad + "]", 2);
  for (int i = 0; i < 3 * kVoidReserve; ++i) many += "[1,2,0],";  // of 3 points
  expect_refused(image, "[1,2,4]", many + "[1,2,4]", 2);
  expect_refused(image, "\"map_ms\":10", "\"map_ms\":1e300", 2);
  for (const char* bad : {"-1", "1e300", "0.5", "1000000000000000000", "null"})
    for (const char* key : {"\"frames\":3", "\"points\":3", "\"shard\":1", "\"shards\":1"}) {
      const std::string name(key, std::string(key).find(':') + 1);
      expect_refused(plan, key, name + bad, 1);
    }
}

TEST_F(ResultFileTest, AFrameThatIsThereTwiceIsAnError) {
  const auto images = sample_images();
  write_results(folder_, sample_plan(), {images[0], images[0]}, false);
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_all({scan_results(folder_)}); }),
              HasSubstr("frame 0 is there twice"));
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return resume_results(folder_, sample_plan()); }),
              HasSubstr("results.jsonl:3"));
}

TEST_F(ResultFileTest, AFrameOfAnotherEvaluationIsAnError) {
  auto images = sample_images();
  images[1].frame = 7;
  write_results(folder_, sample_plan(), images, false);
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return resume_results(folder_, sample_plan()); }),
              HasSubstr("frame 7 is not part of it"));
}

TEST_F(ResultFileTest, ASymbolicLinkIsNotFollowed) {
  write_file(folder_ / "other", plan_line(sample_plan()) + "\nhalf a line");
  fs::create_directories(folder_ / "out");
  fs::create_symlink(folder_ / "other", folder_ / "out" / kResultFile);
  EXPECT_THROW((void)resume_results(folder_ / "out", sample_plan()), Error);
  EXPECT_EQ(read_file(folder_ / "other").size(), plan_line(sample_plan()).size() + 12);
}

}  // namespace
}  // namespace saccade
