#include "eval/result_file.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "eval/hit_ratio.hpp"
#include "samples.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ResultFileTest : public FolderTest {
 protected:
  void put(const std::string& text, const std::string& sub = "") const {
    fs::create_directories(folder_ / sub);
    write_file(folder_ / sub / kResultFile, text);
  }
  std::string text() const {
    const auto bytes = read_file(folder_ / kResultFile);
    return {bytes.begin(), bytes.end()};
  }

  template <typename Action>
  static std::string error_of(ExitStatus status, Action action) {
    try {
      action();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), status) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "no error came";
    return "";
  }

  // A folder with the shard's part of the sample.
  fs::path put_shard(int shard, int shards, bool complete = true, EvalPlan plan = sample_plan()) const {
    plan.shard = shard;
    plan.shards = shards;
    const auto images = sample_images();
    std::string lines = plan_line(plan) + "\n";
    for (std::size_t i = static_cast<std::size_t>(shard - 1); i < images.size();
         i += static_cast<std::size_t>(shards))
      lines += image_line(images[i]) + "\n";
    const std::string name = std::to_string(shard);
    put(complete ? lines + end_line() + "\n" : lines, name);
    return folder_ / name;
  }
};

TEST_F(ResultFileTest, WhatIsWrittenIsRead) {
  const StoredResults results{sample_plan(), sample_images(), true};
  write_results(folder_, results);
  const StoredResults again = read_results(folder_);
  EXPECT_TRUE(again.complete);
  ASSERT_EQ(again.images.size(), 3U);
  EXPECT_EQ(plan_line(again.plan), plan_line(results.plan));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(image_line(again.images[i]), image_line(results.images[i]));
  EXPECT_EQ(again.images[0].conditions[1].points[2].label, 5);
  EXPECT_EQ(again.images[2].name, "a,\"b\"");
}

TEST_F(ResultFileTest, VoidIsWrittenAndRead) {
  StoredResults results{sample_plan(), sample_images(), true};
  results.images[0].void_known = true;
  results.images[0].conditions[0].points[2].label = kVoid;
  write_results(folder_, results);
  const StoredResults again = read_results(folder_);
  EXPECT_TRUE(again.images[0].void_known);
  EXPECT_EQ(again.images[0].conditions[0].points[2].label, kVoid);
  EXPECT_FALSE(again.images[2].void_known);
}

TEST_F(ResultFileTest, ConfidencesAreWrittenAndRead) {
  StoredResults results{sample_plan(), sample_images(), true};
  results.images[0].conditions[0].points[1].confidence = 0.9342711F;
  write_results(folder_, results);
  const auto read = read_results(folder_).images[0].conditions[0].points;
  EXPECT_EQ(read[1].confidence, 0.9342711F);
  EXPECT_FALSE(read[0].confidence);
}

TEST_F(ResultFileTest, ANewFileHoldsThePlan) {
  const StoredResults results = resume_results(folder_, sample_plan());
  EXPECT_TRUE(results.images.empty());
  EXPECT_FALSE(results.complete);
  EXPECT_EQ(text(), plan_line(sample_plan()) + "\n");
}

TEST_F(ResultFileTest, ACutLastLineIsTakenOff) {
  const std::string whole = plan_line(sample_plan()) + "\n" + image_line(sample_images()[0]) + "\n";
  const std::string cut = image_line(sample_images()[2]);
  for (const std::size_t length : {std::size_t{1}, cut.size() / 2, cut.size()}) {
    put(whole + cut.substr(0, length));
    const StoredResults results = resume_results(folder_, sample_plan());
    EXPECT_EQ(results.images.size(), 1U);
    EXPECT_FALSE(results.complete);
    EXPECT_EQ(text(), whole);
  }
  put(plan_line(sample_plan()).substr(0, 30));
  EXPECT_TRUE(resume_results(folder_, sample_plan()).images.empty());
  EXPECT_EQ(text(), plan_line(sample_plan()) + "\n");
}

TEST_F(ResultFileTest, AnotherPlanIsNotGoneOnWith) {
  EXPECT_TRUE(resume_results(folder_, sample_plan()).images.empty());
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
    EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_results(folder_); }),
                HasSubstr("results.jsonl:3"));
    put(bad);
    EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_results(folder_); }),
                HasSubstr("results.jsonl:1"));
  }
  ImageResult fewer = sample_images()[0];
  fewer.conditions.pop_back();
  put(plan + image_line(fewer) + "\n");
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_results(folder_); }),
              HasSubstr("numbers of"));
  error_of(ExitStatus::unreadable, [&] { return read_results(folder_ / "nowhere"); });
}

TEST_F(ResultFileTest, EveryNumberHasARange) {
  const std::string plan = plan_line(sample_plan()), image = image_line(sample_images()[0]);
  const auto expect_refused = [&](std::string text, const std::string& from, const std::string& to,
                                  int line) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    put(line == 1 ? text + "\n" : plan + "\n" + text + "\n");
    EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_results(folder_); }),
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
  expect_refused(image, "\"map_ms\":10", "\"map_ms\":1e300", 2);
  for (const char* bad : {"-1", "1e300", "0.5", "1000000000000000000", "null"})
    for (const char* key : {"\"frames\":3", "\"points\":3", "\"shard\":1", "\"shards\":1"}) {
      const std::string name(key, std::string(key).find(':') + 1);
      expect_refused(plan, key, name + bad, 1);
    }
}

TEST_F(ResultFileTest, AFrameThatIsThereTwiceIsAnError) {
  const std::string image = image_line(sample_images()[0]) + "\n";
  put(plan_line(sample_plan()) + "\n" + image + image);
  EXPECT_THAT(error_of(ExitStatus::unreadable, [&] { return read_results(folder_); }),
              HasSubstr("frame 0 is there twice"));
}

TEST_F(ResultFileTest, ASymbolicLinkIsNotFollowed) {
  write_file(folder_ / "other", plan_line(sample_plan()) + "\nhalf a line");
  fs::create_directories(folder_ / "out");
  fs::create_symlink(folder_ / "other", folder_ / "out" / kResultFile);
  EXPECT_THROW((void)resume_results(folder_ / "out", sample_plan()), Error);
  EXPECT_EQ(read_file(folder_ / "other").size(), plan_line(sample_plan()).size() + 12);
}

TEST_F(ResultFileTest, MergedShardsAreTheWhole) {
  const StoredResults merged = merge_results({put_shard(2, 3), put_shard(3, 3), put_shard(1, 3)});
  EXPECT_TRUE(merged.complete);
  EXPECT_EQ(plan_line(merged.plan), plan_line(sample_plan()));
  ASSERT_EQ(merged.images.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(image_line(merged.images[i]), image_line(sample_images()[i]));
}

TEST_F(ResultFileTest, WhatCannotBeMerged) {
  const auto one = put_shard(1, 3), two = put_shard(2, 3);
  const auto merge = [](const std::vector<fs::path>& folders) { return merge_results(folders); };
  EXPECT_THAT(error_of(ExitStatus::usage, [&] { merge({one, two}); }), HasSubstr("3/3 is missing"));
  EXPECT_THAT(error_of(ExitStatus::usage, [&] { merge({one, two, one}); }), HasSubstr("1/3 is given twice"));
  const auto three = put_shard(3, 3, false);
  EXPECT_THAT(error_of(ExitStatus::usage, [&] { merge({one, two, three}); }), HasSubstr("not complete"));
  EvalPlan other = sample_plan();
  other.dataset = "elsewhere";
  put_shard(3, 3, true, other);
  EXPECT_THAT(error_of(ExitStatus::usage, [&] { merge({one, two, three}); }), HasSubstr("dataset is"));
}

}  // namespace
}  // namespace saccade
