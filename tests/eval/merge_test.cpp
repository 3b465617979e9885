#include "eval/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_lock.hpp"
#include "samples.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MergeTest : public FolderTest {
 protected:
  // A folder with the shard's part of the sample.
  fs::path put_shard(int shard, int shards, bool complete = true, EvalPlan plan = sample_plan()) const {
    plan.shard = shard;
    plan.shards = shards;
    const auto images = sample_images();
    std::string lines = plan_line(plan) + "\n";
    for (std::size_t i = static_cast<std::size_t>(shard - 1); i < images.size();
         i += static_cast<std::size_t>(shards))
      lines += image_line(images[i]) + "\n";
    const fs::path folder = folder_ / std::to_string(shard);
    fs::create_directories(folder);
    write_file(folder / kResultFile, complete ? lines + end_line() + "\n" : lines);
    return folder;
  }

  static std::string complaint(const std::vector<fs::path>& folders) {
    return error_of(ExitStatus::usage, [&] { return find_shards(folders, false); });
  }
};

TEST_F(MergeTest, MergedShardsAreTheWhole) {
  const auto shards = find_shards({put_shard(2, 3), put_shard(3, 3), put_shard(1, 3)}, false);
  EXPECT_TRUE(shards.complete);
  EXPECT_EQ(shards.plan.missing, "");
  const ResultFile merged = write_merged(folder_, shards);
  write_results(folder_ / "1", sample_plan(), sample_images());
  EXPECT_EQ(read_file(folder_ / kResultFile), read_file(folder_ / "1" / kResultFile));
  const ResultFile again = scan_results(folder_);
  EXPECT_EQ(merged.images, again.images);
  EXPECT_EQ(merged.bytes, again.bytes);
  ASSERT_EQ(again.runs.size(), 1U);
  EXPECT_EQ(merged.runs[0].begin, again.runs[0].begin);
  EXPECT_EQ(merged.runs[0].end, again.runs[0].end);
  EXPECT_EQ(read_all({merged}).size(), 3U);
}

TEST_F(MergeTest, EveryShardThatIsMissingOrNotCompleteIsNamed) {
  const auto one = put_shard(1, 9), four = put_shard(4, 9), five = put_shard(5, 9, false);
  const std::string lack = "of 9 shards, shards 2, 3, 6-9 are missing and shard 5 is not complete";
  EXPECT_THAT(complaint({one, four, five}), HasSubstr(lack));
  const ShardedResults partial = find_shards({one, four, five}, true);
  EXPECT_FALSE(partial.complete);
  EXPECT_EQ(partial.plan.missing, lack + "; 1 of 3 images");
  EXPECT_EQ(partial.plan.shards, 1);
}

TEST_F(MergeTest, ShardsOfDifferentEvaluationsAreRefused) {
  const auto one = put_shard(1, 3), two = put_shard(2, 3);
  EXPECT_THAT(complaint({one, two, one}), HasSubstr("1/3 is given twice"));
  EvalPlan other = sample_plan();
  other.settings.last_level = 3;
  EXPECT_THAT(complaint({one, put_shard(2, 3, true, other)}), HasSubstr("levels is \"0..4\", not \"0..3\""));
  put_shard(2, 3);
  other = sample_plan();
  other.dataset = "the same/elsewhere";
  EXPECT_TRUE(find_shards({one, two, put_shard(3, 3, true, other)}, false).complete);
  other.content = "0123456789abcdef";
  EXPECT_THAT(complaint({one, two, put_shard(3, 3, true, other)}),
              HasSubstr("the images of the data sets \"some/folder\" and \"the same/elsewhere\" differ"));
}

TEST_F(MergeTest, StatusOfShards) {
  const auto one = put_shard(1, 4), three = put_shard(3, 4, false);
  fs::create_directory(folder_ / "empty");
  const FolderLock lock(three, "saccade eval");
  const auto status = shard_status({one, three, folder_ / "empty"});
  ASSERT_EQ(status.size(), 3U);
  EXPECT_TRUE(status[0].complete);
  EXPECT_EQ(status[0].running, "");
  EXPECT_EQ(status[1].shard, 3);
  EXPECT_EQ(status[1].done, 1);
  EXPECT_EQ(status[1].of, 1);
  EXPECT_FALSE(status[1].complete);
  EXPECT_THAT(status[1].running, HasSubstr("saccade eval, process "));
  EXPECT_THAT(status[2].problem, HasSubstr("results.jsonl"));
  EXPECT_EQ(missing_shards(status), "2, 4");
}

TEST(RangesText, JoinsNeighbours) {
  EXPECT_EQ(ranges_text({}), "");
  EXPECT_EQ(ranges_text({4}), "4");
  EXPECT_EQ(ranges_text({1, 2, 4, 5, 6, 9}), "1, 2, 4-6, 9");
}

}  // namespace
}  // namespace saccade
