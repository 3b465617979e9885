// OpenNI2's own player plays our recordings with the same pixels, and our reader reads other recordings as
// that player does.
#include <cstdlib>

#include "oni/recording.hpp"
#include "oni/repair.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/outcome.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;

struct Played {
  std::uint64_t timestamp_us = 0;
  std::uint32_t number = 0;
  cv::Mat1w depth;
};

class StockPlayer : public OniFiles {
 protected:
  std::vector<Played> play(const fs::path& file) {
    const fs::path out = path("played");
    const std::string command =
        "timeout 30 '" STOCK_PLAYER "' '" + file.string() + "' '" + out.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    const std::vector<std::uint8_t> bytes = read_bytes(out);
    std::vector<Played> frames;
    ByteCursor cursor(bytes);
    while (!cursor.rest().empty()) {
      Played frame;
      frame.timestamp_us = cursor.take<std::uint64_t>().value();
      frame.number = cursor.take<std::uint32_t>().value();
      const int width = static_cast<int>(cursor.take<std::uint32_t>().value());
      const int height = static_cast<int>(cursor.take<std::uint32_t>().value());
      frame.depth.create(height, width);
      const auto pixels = cursor.take_bytes(2 * frame.depth.total());
      if (!pixels) {
        ADD_FAILURE() << "a short frame";
        return frames;
      }
      std::memcpy(frame.depth.data, pixels->data(), pixels->size());
      frames.push_back(std::move(frame));
    }
    return frames;
  }

  // The stock player and ours give the same `count` frames, bit for bit.
  void expect_same(const fs::path& file, std::size_t count) {
    SCOPED_TRACE(file.string());
    const std::vector<Played> played = play(file);
    Recording recording(file);
    const OniNode& node = *main_depth(recording);
    ASSERT_EQ(node.frames.size(), count);
    ASSERT_EQ(played.size(), count);
    cv::Mat1w depth;
    for (std::size_t k = 0; k < count; ++k) {
      ASSERT_TRUE(succeeded(recording.read_stored_depth(node, k, depth)));
      EXPECT_TRUE(equal(depth(recording.format(node, k).crop), played[k].depth)) << "frame " << k;
      EXPECT_EQ(played[k].timestamp_us, node.frames[k].timestamp_us);
      EXPECT_EQ(played[k].number, node.frames[k].number);
    }
  }
};

TEST_F(StockPlayer, PlaysOurRecordingsOfEveryCodec) {
  for (const OniDepthCodec depth : {OniDepthCodec::z16t, OniDepthCodec::z16p, OniDepthCodec::none})
    for (const OniColourCodec colour : {OniColourCodec::jpeg, OniColourCodec::none, OniColourCodec::off}) {
      record_test_frames(path("a.oni"), 12, {160, 120}, true,
                         {.depth_codec = depth, .colour_codec = colour, .overwrite = true});
      expect_same(path("a.oni"), 12);
    }
}

TEST_F(StockPlayer, PlaysFineUnitsAndLargeDepths) {
  record_test_frames(path("fine.oni"), 3, {80, 60}, false, {.depth_unit = OniDepthUnit::um100});
  expect_same(path("fine.oni"), 3);
  OniWriter writer(path("far.oni"), {});
  Frame frame = test_frame(0, {80, 60}, false);
  for (int k = 0; k < 3; ++k) {
    frame.depth_mm(10 + k, 20) = 65534.0f;
    frame.depth_mm(30, 20 + k) = 40000.0f;
    writer.write(frame);
  }
  writer.close();
  expect_same(path("far.oni"), 3);
}

TEST_F(StockPlayer, PlaysARepairedRecording) {
  record_test_frames(path("whole.oni"), 10, {80, 60}, true);
  const std::vector<std::uint8_t> whole = read_bytes(path("whole.oni"));
  const Recording recording(path("whole.oni"));
  // Truncated in the seventh depth frame.
  const std::uint64_t cut = main_depth(recording)->frames[6].payload_position + 100;
  write_bytes(path("cut.oni"), std::span(whole).first(cut));
  repair_recording(path("cut.oni"), path("repaired.oni"), false);
  expect_same(path("repaired.oni"), 6);
}

TEST_F(StockPlayer, PlaysTheRepairedRecordingOfAKilledProcess) {
  OniWriter* writer = new OniWriter(path("open.oni"), {});  // never closed, as after kill -9
  for (int k = 0; k < 5; ++k) writer->write(test_frame(k, {80, 60}, false));
  fs::copy_file(path("open.oni"), path("killed.oni"));
  writer->close();
  delete writer;
  repair_recording(path("killed.oni"), path("repaired.oni"), false);
  expect_same(path("repaired.oni"), 5);
}

TEST_F(StockPlayer, AgreesOnRecordingsOfOtherPrograms) {
  const fs::path shared = in_shared("");
  if (!fs::exists(shared / "formats/samples/tiny.oni")) GTEST_SKIP() << "no sample recordings";
  for (const auto& [name, count] : std::map<std::string, std::size_t>{{"formats/samples/ni1_a.oni", 4},
                                                                      {"formats/samples/sample.oni", 6},
                                                                      {"formats/samples/t_crop.oni", 5},
                                                                      {"formats/samples/t_101_201.oni", 4},
                                                                      {"formats/samples/t_prop.oni", 8},
                                                                      {"formats/samples/tiny.oni", 2},
                                                                      {"data/oni/3dj_test.oni", 12}})
    expect_same(shared / name, count);
}

}  // namespace
}  // namespace saccade
