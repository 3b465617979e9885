// The example of src/oni/README.md is what the program writes and reads.
#include <algorithm>
#include <fstream>
#include <string>

#include "oni/check.hpp"
#include "oni/recording.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/outcome.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

const cv::Mat1w kFirst = (cv::Mat1w(2, 4) << 0, 0, 0, 810, 0, 0, 0, 811);
const cv::Mat1w kSecond = (cv::Mat1w(2, 4) << 800, 800, 800, 800, 806, 900, 900, 2000);

// The bytes of the block ```hex of the specification, without its comments.
std::vector<std::uint8_t> example_of_specification() {
  std::ifstream file(in_source("src/oni/README.md"));
  std::string line, digits;
  bool inside = false;
  while (std::getline(file, line)) {
    if (inside && line == "```") break;
    if (inside) digits += line.substr(0, line.find('#'));
    if (line == "```hex") inside = true;
  }
  std::erase(digits, ' ');
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::vector<std::uint8_t> coded(const cv::Mat1w& depth) {
  std::vector<std::uint8_t> payload;
  EXPECT_TRUE(Encoder16z().encode(Codec16z::table, {depth[0], depth.total()}, payload));
  return payload;
}

class OniExample : public OniFiles {
 protected:
  void write_example(const std::filesystem::path& file) const {
    OniRecordWriter writer(file, true);
    OniNodeFields depth;
    depth.name = "Depth";
    depth.type = OniNodeType::depth;
    depth.codec = OniCodec::z16t;
    writer.add_node(1, depth);
    writer.add_int(1, oni_property::kMaxDepth, 65535);
    ByteBuilder mode;
    for (const std::uint32_t value : {4u, 2u, 30u}) mode.put(value);
    writer.add_property(1, OniRecordType::general_property, oni_property::kMode, mode.bytes());
    writer.add_property(1, OniRecordType::general_property, oni_property::kCropping,
                        std::array<std::uint8_t, 12>{});
    writer.begin();
    EXPECT_TRUE(writer.write_frame(1, 0, coded(kFirst)));
    EXPECT_TRUE(writer.write_frame(1, 33333, coded(kSecond)));
    writer.close();
  }
};

TEST_F(OniExample, IsWrittenByteForByte) {
  write_example(path("example.oni"));
  const auto expected = example_of_specification(), written = read_bytes(path("example.oni"));
  ASSERT_FALSE(expected.empty());
  const auto [at, other] = std::ranges::mismatch(written, expected);
  EXPECT_EQ(written, expected) << "first difference at byte " << at - written.begin();
}

TEST_F(OniExample, IsReadAsTheSpecificationSays) {
  write_bytes(path("example.oni"), example_of_specification());
  Recording recording(path("example.oni"));
  const OniProblems problems = check_recording(recording);
  EXPECT_TRUE(problems.list().empty());
  ASSERT_EQ(recording.index().nodes.size(), 1u);
  const OniNode& node = recording.index().nodes[0];
  ASSERT_EQ(node.frames.size(), 2u);
  EXPECT_EQ(node.frames[1].timestamp_us, 33333u);
  cv::Mat1w depth;
  ASSERT_TRUE(succeeded(recording.read_stored_depth(node, 0, depth)));
  EXPECT_TRUE(equal(depth, kFirst));
  ASSERT_TRUE(succeeded(recording.read_stored_depth(node, 1, depth)));
  EXPECT_TRUE(equal(depth, kSecond));
}

}  // namespace
}  // namespace saccade
