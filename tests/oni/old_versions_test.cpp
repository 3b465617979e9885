#include "oni/recording.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/outcome.hpp"

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kFileHeader = 24, kRecordHeader = 28, kNarrowHeader = 24, kNameLength = 28;

// The size of the fields of NODE_ADDED in an old version, without the table position. Today's has name, type
// and codec, then u32 frames, two u64 times and a u64 table position.
std::size_t node_fields(const Bytes& file, std::size_t at, std::uint32_t build) {
  const std::size_t first = 4 + load_le<std::uint32_t>(&file[at + kNameLength]) + 8;
  return build == 4 ? first : first + 20;
}

// Converts a file of today to an old version (README 1): 24-byte record headers, u32 positions, other
// NODE_ADDED records, and no seek tables.
Bytes as_written_by(std::uint32_t build, const Bytes& file) {
  ByteBuilder out;
  out.put_bytes(std::span(file).first(6));
  out.put(std::uint16_t{0});
  out.put(build);
  out.put_bytes(std::span(file).subspan(12, 12));
  for (std::size_t at = kFileHeader; at + kRecordHeader <= file.size();) {
    const auto type = load_le<OniRecordType>(&file[at + 4]);
    const std::size_t fields = load_le<std::uint32_t>(&file[at + 12]),
                      payload = load_le<std::uint32_t>(&file[at + 16]);
    const bool node = type == OniRecordType::node_added;
    const std::size_t kept = node ? node_fields(file, at, build) : fields - kRecordHeader;
    if (type != OniRecordType::seek_table) {
      out.put_bytes(std::span(file).subspan(at, 4));
      out.put(!node        ? type
              : build == 4 ? OniRecordType::node_added_1004
              : build == 5 ? OniRecordType::node_added_1005
                           : OniRecordType::node_added);
      out.put_bytes(std::span(file).subspan(at + 8, 4));
      out.put(static_cast<std::uint32_t>(kNarrowHeader + kept + (node && build == 6 ? 4 : 0)));
      out.put(static_cast<std::uint32_t>(payload));
      out.put(std::uint32_t{0});
      out.put_bytes(std::span(file).subspan(at + kRecordHeader, kept));
      if (node && build == 6) out.put(std::uint32_t{0});  // the position of a table: none
      out.put_bytes(std::span(file).subspan(at + fields, payload));
    }
    at += fields + payload;
  }
  return out.take();
}

class OldVersions : public OniFiles, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(OldVersions, GiveTheSameFrames) {
  constexpr int kFrames = 5;
  record_test_frames(path("new.oni"), kFrames, {32, 24}, true);
  write_bytes(path("old.oni"), as_written_by(GetParam(), read_bytes(path("new.oni"))));
  Recording now(path("new.oni")), old(path("old.oni"));
  EXPECT_EQ(to_string(old.index().header.version), "1.0.0." + std::to_string(GetParam()));
  ASSERT_EQ(old.index().nodes.size(), now.index().nodes.size());
  for (std::size_t n = 0; n < old.index().nodes.size(); ++n) {
    const OniNode &a = now.index().nodes[n], &b = old.index().nodes[n];
    EXPECT_EQ(a.declared.type, b.declared.type);
    ASSERT_EQ(b.frames.size(), std::size_t{kFrames});
    for (std::size_t k = 0; k < b.frames.size(); ++k) {
      cv::Mat1f depth_a, depth_b;
      cv::Mat3b colour_a, colour_b;
      if (a.declared.type == OniNodeType::depth) {
        EXPECT_TRUE(succeeded(now.read_depth(a, k, depth_a)));
        EXPECT_TRUE(succeeded(old.read_depth(b, k, depth_b)));
        EXPECT_TRUE(equal(depth_a, depth_b)) << k;
      } else {
        EXPECT_TRUE(succeeded(now.read_colour(a, k, colour_a)));
        EXPECT_TRUE(succeeded(old.read_colour(b, k, colour_b)));
        EXPECT_TRUE(equal(colour_a, colour_b)) << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Build, OldVersions, ::testing::Values(4u, 5u, 6u));

}  // namespace
}  // namespace saccade
