#include "sources/pcd.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pcd_writer.hpp"
#include "sources/lzf.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;

std::string reason(const std::vector<std::uint8_t>& pcd) {
  try {
    read_pcd(pcd);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

std::string replaced(const std::vector<std::uint8_t>& pcd, const std::string& from, const std::string& to) {
  std::string text(pcd.begin(), pcd.end());
  return text.replace(text.find(from), from.size(), to);
}

class PcdTest : public ::testing::TestWithParam<PcdEncoding> {
 protected:
  std::vector<std::uint8_t> sample() const { return write_pcd(sample_depth(), kCamera, GetParam()); }

  static constexpr Intrinsics kCamera{50, 52, 15.25, 10.5, IntrinsicsOrigin::file};
  static cv::Mat1f sample_depth() {
    cv::Mat1f depth(20, 32);
    for (int r = 0; r < depth.rows; ++r)
      for (int c = 0; c < depth.cols; ++c)
        depth(r, c) = (r + c) % 7 == 0 ? 0.0F : 1000 + 10 * static_cast<float>(r) + static_cast<float>(c);
    return depth;
  }
};

TEST_P(PcdTest, DepthAndCameraComeBack) {
  const OrganisedCloud cloud = read_pcd(sample());
  EXPECT_EQ(read_pcd_size(sample()), cv::Size(32, 20));
  ASSERT_EQ(cloud.depth_mm.size(), cv::Size(32, 20));
  EXPECT_LT(cv::norm(cloud.depth_mm, sample_depth(), cv::NORM_INF), 0.01) << "no point is 0";
  ASSERT_TRUE(cloud.intrinsics);
  EXPECT_EQ(cloud.intrinsics->origin, IntrinsicsOrigin::file);
  EXPECT_NEAR(cloud.intrinsics->fx, 50, 0.01);
  EXPECT_NEAR(cloud.intrinsics->fy, 52, 0.01);
  EXPECT_NEAR(cloud.intrinsics->cx, 15.25, 0.01);
  EXPECT_NEAR(cloud.intrinsics->cy, 10.5, 0.01);
}

TEST_P(PcdTest, ColoursComeBack) {
  EXPECT_TRUE(read_pcd(sample()).colour.empty()) << "there are none";
  cv::Mat3b colour(20, 32);
  for (int r = 0; r < colour.rows; ++r)
    for (int c = 0; c < colour.cols; ++c)
      colour(r, c) = cv::Vec3b(static_cast<std::uint8_t>(8 * c), static_cast<std::uint8_t>(12 * r),
                               static_cast<std::uint8_t>(r * c));
  auto pcd = write_pcd(sample_depth(), kCamera, GetParam(), colour);
  const cv::Mat3b read = read_pcd(pcd).colour;
  ASSERT_EQ(read.size(), colour.size());
  EXPECT_EQ(cv::norm(read, colour, cv::NORM_INF), 0) << "also where there is no point";
  EXPECT_TRUE(read_pcd(bytes_of(replaced(pcd, "rgb", "red"))).colour.empty()) << "not a colour";
}

TEST_P(PcdTest, CutFilesAreAnError) {
  const auto whole = sample();
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 40) {
    // A number of ascii may be cut so that it still is one.
    if (GetParam() == PcdEncoding::ascii && whole.size() - length < 20) break;
    EXPECT_NE(reason({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}), "") << length;
  }
}

// Whatever a byte is: a cloud, or a reason; the sanitizers watch.
TEST_P(PcdTest, DamagedFilesDoNoHarm) {
  const auto whole = sample();
  for (std::size_t at = 0; at < whole.size(); at += 1 + at / 300)
    for (const int value : {0, 0x20, 0x39, 0x7f, 0xff}) {
      auto damaged = whole;
      damaged[at] = static_cast<std::uint8_t>(value);
      try {
        const OrganisedCloud cloud = read_pcd(damaged);
        double least = 0, most = 0;
        cv::minMaxLoc(cloud.depth_mm, &least, &most);
        EXPECT_TRUE(least >= 0 && std::isfinite(most));
      } catch (const std::runtime_error&) {
        // The reason is given.
      }
    }
}

TEST_P(PcdTest, HeadersThatCannotBe) {
  const auto pcd = sample();
  const struct {
    const char *from, *to, *says;
  } kCases[] = {
      {"HEIGHT 20", "HEIGHT 1", "not organised"},
      {"HEIGHT 20", "HEIGHT 21", "POINTS is not WIDTH times HEIGHT"},
      {"WIDTH 32", "WIDTH 9000", "larger than 8192"},
      {"WIDTH 32", "WIDTH -32", "integer"},
      {"FIELDS x", "FIELDS q", "no field x"},
      {"SIZE 4 4", "SIZE 4 2", "field y is not one float"},
      {"SIZE 4 4", "SIZE 4", "SIZE is not given for each field"},
      {"TYPE F", "TYPE U", "field x is not one float"},
      {"COUNT 1", "COUNT 2", "field x is not one float"},
      {"COUNT 1", "COUNT 9999999", "integer"},
      {"DATA ", "DATA x", "its DATA is not ascii"},
      {"DATA ", "ATAD ", "unknown line"},
  };
  for (const auto& wrong : kCases)
    EXPECT_THAT(reason(bytes_of(replaced(pcd, wrong.from, wrong.to))), HasSubstr(wrong.says)) << wrong.to;
}

INSTANTIATE_TEST_SUITE_P(Encodings, PcdTest,
                         ::testing::Values(PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::compressed),
                         [](const auto& encoding) { return to_string(encoding.param); });

TEST(Pcd, AHeaderWithoutEnd) {
  EXPECT_THAT(reason({}), HasSubstr("no DATA line"));
  EXPECT_THAT(reason(bytes_of("# .PCD v0.7\nVERSION 0.7\nWIDTH 4\n")), HasSubstr("no DATA line"));
  EXPECT_THAT(reason(bytes_of("WIDTH\n")), HasSubstr("nothing follows WIDTH"));
}

TEST(Pcd, PointsThatFitNoCameraGiveNone) {
  cv::Mat1f depth(20, 32, 1000.0F);
  const auto pcd = write_pcd(depth, {50, 50, 15, 10}, PcdEncoding::ascii);
  std::string text(pcd.begin(), pcd.end());
  const std::size_t body = text.find("DATA ascii\n") + 11;
  std::string shuffled = text.substr(0, body);
  for (int i = 0; i < 20 * 32; ++i)
    shuffled += fmt::format("1 {} {}\n", (i * 7919) % 641 * 0.01, (i * 31) % 5 * 0.1);
  const auto bytes = bytes_of(shuffled);
  const std::string swapped = replaced(bytes, "FIELDS x y z", "FIELDS z x y");
  EXPECT_FALSE(read_pcd(bytes_of(swapped)).intrinsics);
  EXPECT_EQ(cv::countNonZero(read_pcd(bytes_of(swapped)).depth_mm != 1000), 0) << "fields in another order";
}

// As the tools of the Point Cloud Library also write it: TYPE U, as an integer, under the name of rgba.
TEST(Pcd, ColoursMayBeIntegers) {
  std::string text =
      "VERSION 0.7\nFIELDS rgba x y z\nSIZE 4 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 2\n"
      "POINTS 4\nDATA ascii\n4278255361 0 0 1\n65280 0 0 1\n16711680 0 0 1\n-1 0 0 1\n";
  const cv::Mat3b colour = read_pcd(bytes_of(text)).colour;
  EXPECT_EQ(colour(0, 0), cv::Vec3b(1, 255, 0)) << "0xff00ff01: the first byte is alpha";
  EXPECT_EQ(colour(0, 1), cv::Vec3b(0, 255, 0));
  EXPECT_EQ(colour(1, 0), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(colour(1, 1), cv::Vec3b(0, 0, 0)) << "no colour";
}

TEST(Lzf, LiteralsAndReferences) {
  // "abc", then 6 bytes from 3 back, then (long form) 9 + 1 bytes from 1 back.
  const std::vector<std::uint8_t> input = {2, 'a', 'b', 'c', 4 << 5, 2, 7 << 5, 1, 0};
  std::vector<std::uint8_t> output(19);
  ASSERT_TRUE(lzf_decompress(input, output));
  EXPECT_EQ(std::string(output.begin(), output.end()), "abcabcabccccccccccc");
  std::vector<std::uint8_t> small(18), large(20);
  EXPECT_FALSE(lzf_decompress(input, small));
  EXPECT_FALSE(lzf_decompress(input, large));
}

TEST(Lzf, DamagedDataAreRefused) {
  std::vector<std::uint8_t> output(8);
  const std::vector<std::vector<std::uint8_t>> wrong = {
      {},         {7, 'a'}, {0, 'a', 6 << 5}, {0, 'a', 7 << 5}, {0, 'a', 7 << 5, 0}, {0, 'a', 5 << 5, 1},
      {5 << 5, 0}};
  for (const auto& input : wrong) EXPECT_FALSE(lzf_decompress(input, output));
}

}  // namespace
}  // namespace saccade
