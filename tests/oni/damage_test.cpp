#include <random>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "oni/check.hpp"
#include "oni/recording.hpp"
#include "oni/repair.hpp"
#include "oni/walker.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/error_of.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

const cv::Size kWholeSize(20, 12);
constexpr int kWholeFrames = 4;

class DamageTest : public OniFiles {
 protected:
  Bytes whole_;
  std::vector<std::uint64_t> frame_ends_;  // of the depth frames' records

  void SetUp() override {
    OniFiles::SetUp();
    record_test_frames(path("whole.oni"), kWholeFrames, kWholeSize, true);
    whole_ = read_bytes(path("whole.oni"));
    const Recording recording(path("whole.oni"));
    for (const OniFrameEntry& frame : main_depth(recording)->frames)
      frame_ends_.push_back(frame.payload_position + frame.payload_size);
  }

  // The recorded frames that equal a readable depth frame of the file, in its order.
  std::vector<int> frames_of(const std::filesystem::path& file) {
    Recording recording(file);
    std::vector<int> found;
    const OniNode* node = main_depth(recording);
    cv::Mat1f depth;
    for (std::size_t k = 0; node != nullptr && k < node->frames.size(); ++k) {
      if (!recording.read_depth(*node, k, depth)) continue;
      for (int n = 0; n < kWholeFrames; ++n)
        if (equal(depth, test_frame(n, kWholeSize, true).depth_mm)) found.push_back(n);
    }
    return found;
  }

  std::string problems_of(const std::filesystem::path& file) {
    Recording recording(file);
    std::string all;
    const OniProblems problems = check_recording(recording);
    for (const OniProblem& problem : problems.list())
      all += std::to_string(problem.position) + " " + problem.meaning + "\n";
    return all;
  }

  bool sound(const std::filesystem::path& file) {
    Recording recording(file);
    return is_sound(check_recording(recording));
  }
};

std::vector<int> first_frames(int count) {
  std::vector<int> frames(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) frames[static_cast<std::size_t>(k)] = k;
  return frames;
}

TEST_F(DamageTest, TruncatedAtAnyByteAllCompleteFramesRemain) {
  ASSERT_TRUE(sound(path("whole.oni")));
  const std::size_t first_frame = frame_ends_.front();
  for (std::size_t cut = 0; cut < whole_.size(); ++cut) {
    write_bytes(path("cut.oni"), std::span(whole_).first(cut));
    if (cut < kOniHeaderSize) {
      ASSERT_THROW(Recording(path("cut.oni")), Error);
      continue;
    }
    const auto there =
        std::count_if(frame_ends_.begin(), frame_ends_.end(), [&](auto end) { return end <= cut; });
    ASSERT_EQ(frames_of(path("cut.oni")), first_frames(static_cast<int>(there))) << "cut at " << cut;
    // Repair waits for the disk, so it runs at a few bytes and at each end of a frame.
    const bool at_end = std::find(frame_ends_.begin(), frame_ends_.end(), cut) != frame_ends_.end();
    if (cut < first_frame || (cut % 41 != 0 && !at_end)) continue;
    ASSERT_FALSE(cut < frame_ends_.back() && sound(path("cut.oni"))) << "cut at " << cut;
    repair_recording(path("cut.oni"), path("repaired.oni"), true);
    ASSERT_EQ(frames_of(path("repaired.oni")), first_frames(static_cast<int>(there))) << "cut at " << cut;
    ASSERT_TRUE(sound(path("repaired.oni"))) << "cut at " << cut << "\n" << problems_of(path("repaired.oni"));
  }
}

TEST_F(DamageTest, ADestroyedStretchCostsOnlyTheFramesItTouches) {
  const Recording recording(path("whole.oni"));
  const auto& frames = main_depth(recording)->frames;
  for (const std::size_t length : {1u, 4u, 30u, 200u}) {
    // The record header of the second frame, or a part of it.
    Bytes damaged = whole_;
    const std::size_t begin = frames[1].payload_position - 40;
    std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(begin), length, std::uint8_t{0xA5});
    write_bytes(path("d.oni"), damaged);
    EXPECT_EQ(frames_of(path("d.oni")), (std::vector<int>{0, 2, 3})) << length;
    EXPECT_FALSE(sound(path("d.oni")));
    EXPECT_THAT(problems_of(path("d.oni")), HasSubstr(std::to_string(begin) + " "));
    const OniRepairReport report = repair_recording(path("d.oni"), path("repaired.oni"), true);
    EXPECT_GT(report.lost_bytes, 0u);
    EXPECT_EQ(frames_of(path("repaired.oni")), (std::vector<int>{0, 2, 3}));
    EXPECT_TRUE(sound(path("repaired.oni"))) << problems_of(path("repaired.oni"));
  }
}

// The search for the next record reads 64 KiB at a time.
TEST_F(DamageTest, ARecordIsFoundWhereTwoReadsOfTheSearchMeet) {
  constexpr std::size_t kRead = 65536, kRecordToPayload = 40;
  const Recording recording(path("whole.oni"));
  const auto& frames = main_depth(recording)->frames;
  const std::size_t record = frames[1].payload_position - kRecordToPayload,
                    end = frames[1].payload_position + frames[1].payload_size;
  for (std::size_t before = 0; before <= 4; ++before) {  // bytes of the magic at the end of the first read
    Bytes damaged = whole_;
    damaged.insert(damaged.begin() + static_cast<std::ptrdiff_t>(end), record + 4 + kRead - before - end,
                   0xA5);
    write_bytes(path("d.oni"), damaged);
    EXPECT_EQ(frames_of(path("d.oni")), first_frames(kWholeFrames)) << before;
  }
}

TEST_F(DamageTest, MoreDamagedPlacesThanAreListedAreCountedAllTheSame) {
  constexpr std::size_t kListed = 1000, kPlaces = kListed + 100, kGarbage = 5;
  const Recording recording(path("whole.oni"));
  const OniFrameEntry& frame = main_depth(recording)->frames[0];
  const auto at = [&](std::uint64_t position) {
    return whole_.begin() + static_cast<std::ptrdiff_t>(position);
  };
  const Bytes record(at(frame.payload_position - 40), at(frame.payload_position + frame.payload_size));
  Bytes damaged(whole_.begin(), at(frame.payload_position - 40));
  for (std::size_t k = 0; k < kPlaces; ++k) {
    // Two at a time: a record counts only where another one follows.
    for (int i = 0; i < 2; ++i) damaged.insert(damaged.end(), record.begin(), record.end());
    damaged.insert(damaged.end(), kGarbage, 0xA5);
  }
  damaged.insert(damaged.end(), record.begin(), record.end());
  write_bytes(path("d.oni"), damaged);
  const InputFile file(path("d.oni"));
  OniWalker walker(file);
  std::size_t found = 0;
  while (const auto next = walker.next()) found += next->type == OniRecordType::new_data ? 1 : 0;
  EXPECT_EQ(found, 2 * kPlaces + 1);
  ASSERT_EQ(walker.gaps().size(), kListed);
  EXPECT_GT(walker.gaps().back().bytes(), 100 * record.size()) << "the last one includes the others";
  EXPECT_EQ(walker.lost_bytes(), kPlaces * kGarbage);
}

TEST_F(DamageTest, AWrongLengthDoesNotHideTheRecordsThatFollow) {
  const Recording recording(path("whole.oni"));
  const std::size_t at = main_depth(recording)->frames[1].payload_position - 40;
  for (const std::size_t field : {at + 12, at + 16}) {  // fieldsSize, payloadSize
    for (const std::uint32_t value : {0u, 27u, 28u, 100u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
      Bytes damaged = whole_;
      store_le(damaged.data() + field, value);
      write_bytes(path("d.oni"), damaged);
      EXPECT_EQ(frames_of(path("d.oni")), (std::vector<int>{0, 2, 3})) << field - at << " = " << value;
    }
  }
}

TEST_F(DamageTest, EveryByteSetToAnyOfSomeValuesIsAtWorstUnreadable) {
  for (std::size_t at = 0; at < whole_.size(); at += 3)
    for (const std::uint8_t value :
         {std::uint8_t{0x00}, std::uint8_t{0x0B}, std::uint8_t{0x7F}, std::uint8_t{0xFF}}) {
      Bytes damaged = whole_;
      if (damaged[at] == value) continue;
      damaged[at] = value;
      write_bytes(path("d.oni"), damaged);
      try {
        Recording recording(path("d.oni"));
        check_recording(recording);
      } catch (const Error& error) {
        ASSERT_EQ(error.status(), ExitStatus::unreadable);
      }
    }
}

TEST_F(DamageTest, AZeroFilledEndIsNoDamageToTheFrames) {
  Bytes damaged = whole_;
  std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(frame_ends_[2]), damaged.end(), std::uint8_t{0});
  write_bytes(path("z.oni"), damaged);
  EXPECT_EQ(frames_of(path("z.oni")), first_frames(3));
  damaged = whole_;
  damaged.resize(2 * whole_.size());
  write_bytes(path("tail.oni"), damaged);
  EXPECT_TRUE(sound(path("tail.oni"))) << "OpenNI2 leaves such a tail";
}

TEST_F(DamageTest, WrongTablesAndCountsAreFoundAndNotUsed) {
  const Recording recording(path("whole.oni"));
  const OniNode& node = *main_depth(recording);
  const std::uint64_t table = node.declared.table_position;
  const auto with = [&](std::uint64_t at, std::uint64_t value) {
    Bytes damaged = whole_;
    store_le(damaged.data() + at, value);
    write_bytes(path("d.oni"), damaged);
    EXPECT_EQ(frames_of(path("d.oni")), first_frames(kWholeFrames));
    EXPECT_FALSE(sound(path("d.oni")));
    return problems_of(path("d.oni"));
  };
  const std::uint64_t counts = node.position + 28 + 4 + 6 + 4 + 4;  // header, "Depth", type, codec
  EXPECT_THAT(with(counts, 0x00000000FFFFFFFF), HasSubstr("declares 4294967295 frames and has 4"));
  EXPECT_THAT(with(counts + 20, 99), HasSubstr("declares its table at 99"));
  EXPECT_THAT(with(table + 28 + 20 + 12, 5), HasSubstr("is wrong from frame 0 on"));
  EXPECT_THAT(with(12, 7), HasSubstr("largest time"));
  EXPECT_THAT(with(20, 0x0052494E00000001), HasSubstr("largest node id"));  // and the next record's magic
}

TEST_F(DamageTest, RepairChangesNeitherTheOriginalNorAnExistingFile) {
  EXPECT_THROW(repair_recording(path("whole.oni"), path("whole.oni"), true), Error);
  write_bytes(path("other"), Bytes{1});
  EXPECT_THROW(repair_recording(path("whole.oni"), path("other"), false), Error);
  EXPECT_EQ(read_bytes(path("other")).size(), 1u);
  repair_recording(path("whole.oni"), path("copy.oni"), false);
  EXPECT_EQ(read_bytes(path("whole.oni")), whole_);
  EXPECT_EQ(frames_of(path("copy.oni")), first_frames(kWholeFrames));
}

TEST_F(DamageTest, ARepairThatSavesNothingIsAnErrorAndKeepsWhatWasThere) {
  const Recording recording(path("whole.oni"));
  Bytes damaged = whole_;
  for (const OniNode& node : recording.index().nodes)
    for (const OniFrameEntry& frame : node.frames)
      for (std::size_t i = 0; i < 8; ++i) damaged[frame.payload_position + i] = 0xFF;
  write_bytes(path("d.oni"), damaged);
  write_bytes(path("before.oni"), Bytes{1, 2, 3});
  for (const char* to : {"new.oni", "before.oni"})
    error_of(ExitStatus::unreadable, [&] { repair_recording(path("d.oni"), path(to), true); });
  EXPECT_FALSE(std::filesystem::exists(path("new.oni")));
  EXPECT_EQ(read_bytes(path("before.oni")), (Bytes{1, 2, 3}));
  EXPECT_FALSE(std::filesystem::exists(path("before.oni.part")));
}

TEST_F(DamageTest, RepairOmitsBadFrames) {
  const Recording recording(path("whole.oni"));
  const OniFrameEntry& frame = main_depth(recording)->frames[2];
  Bytes damaged = whole_;
  // An index beyond the table of values.
  store_le<std::uint16_t>(damaged.data() + frame.payload_position, 1);
  write_bytes(path("d.oni"), damaged);
  const OniRepairReport report = repair_recording(path("d.oni"), path("repaired.oni"), false);
  EXPECT_EQ(report.bad_frames, 1u);
  EXPECT_EQ(frames_of(path("repaired.oni")), (std::vector<int>{0, 1, 3}));
  EXPECT_TRUE(sound(path("repaired.oni")));
}

// A stock player reads beyond the frame if its crop is not within the image.
TEST_F(DamageTest, RepairSwitchesOffACropThatCannotBe) {
  for (const bool possible : {true, false}) {
    OniRecordWriter writer(path("crop.oni"), true);
    add_test_stream(writer, 1, {.width = 4, .height = 3});
    ByteBuilder crop;
    crop.put(std::uint32_t{1});
    for (const int v : {1, 1, 2, possible ? 2 : 3}) crop.put(static_cast<std::uint16_t>(v));
    writer.add_property(1, OniRecordType::general_property, oni_property::kCropping, crop.bytes());
    writer.begin();
    ASSERT_TRUE(writer.write_frame(1, 0, Bytes(std::size_t{2} * (possible ? 2 * 2 : 4 * 3), 1)));
    writer.close();
    EXPECT_EQ(repair_recording(path("crop.oni"), path("repaired.oni"), true).frames, 1u);
    const Recording repaired(path("repaired.oni"));
    const auto kept = cropping_at(*main_depth(repaired), repaired.index().file_size);
    EXPECT_EQ(kept, possible ? std::optional(cv::Rect(1, 1, 2, 2)) : std::nullopt);
  }
}

// What is appended to a recording again and again must not be copied for ever.
TEST_F(DamageTest, RepairCopiesABoundedAmountOfProperties) {
  OniRecordWriter writer(path("many.oni"), true);
  add_test_stream(writer, 1, {.width = 4, .height = 3});
  for (int i = 0; i < 200; ++i)
    writer.add_property(1, OniRecordType::general_property, "of others", Bytes(100'000, 7));
  writer.begin();
  ASSERT_TRUE(writer.write_frame(1, 0, Bytes(24, 1)));
  writer.close();
  ASSERT_GT(std::filesystem::file_size(path("many.oni")), 20'000'000U);
  EXPECT_EQ(repair_recording(path("many.oni"), path("repaired.oni"), true).frames, 1u);
  EXPECT_LT(std::filesystem::file_size(path("repaired.oni")), 17'000'000U);
}

TEST_F(DamageTest, FramesOfAnUnknownNodeAndNodesAddedTwiceAreReported) {
  Bytes damaged = whole_;
  store_le<std::uint32_t>(damaged.data() + 24 + 8, 9);  // the id in the first NODE_ADDED
  write_bytes(path("d.oni"), damaged);
  EXPECT_THAT(problems_of(path("d.oni")), HasSubstr("node 1, which was never added"));
  const Recording recording(path("whole.oni"));
  damaged = whole_;
  store_le<std::uint32_t>(damaged.data() + recording.index().nodes[1].position + 8, 1);
  write_bytes(path("d.oni"), damaged);
  EXPECT_THAT(problems_of(path("d.oni")), HasSubstr("added twice"));
  EXPECT_EQ(frames_of(path("d.oni")), first_frames(kWholeFrames));
}

}  // namespace
}  // namespace saccade
