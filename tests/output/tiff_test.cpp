#include "output/tiff.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

template <typename Image>
Image noise(cv::Size size) {
  Image image(size);
  cv::randn(image, cv::Scalar::all(0), cv::Scalar::all(1000));
  return image;
}

TEST(Tiff, OpenCvReadsGreyFloatsExactly) {
  const cv::Mat1f image = noise<cv::Mat1f>({37, 21})(cv::Rect(3, 2, 30, 17));
  const cv::Mat read = cv::imdecode(encode_tiff(image), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_32FC1);
  ASSERT_EQ(read.size(), image.size());
  EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0);
}

TEST(Tiff, OpenCvReadsThreeChannelsExactlyAndReversed) {
  const cv::Mat3f image = noise<cv::Mat3f>({12, 9});
  cv::Mat read = cv::imdecode(encode_tiff(image), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_32FC3);
  cv::cvtColor(read, read, cv::COLOR_BGR2RGB);
  ASSERT_EQ(read.size(), image.size());
  EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0);
}

// The value of a field, which OpenCV need not care about but other readers do.
int field_of(const std::vector<std::uint8_t>& tiff, int tag) {
  constexpr std::size_t kFirst = 10, kField = 12;
  for (std::size_t at = kFirst; at < kFirst + tiff[8] * kField; at += kField)
    if ((tiff[at] | tiff[at + 1] << 8) == tag) return tiff[at + 8] | tiff[at + 9] << 8;
  return -1;
}

TEST(Tiff, GreyGrowsFromBlackToWhite) {
  constexpr int kPhotometric = 262, kBlackIsZero = 1, kRgb = 2;
  EXPECT_EQ(field_of(encode_tiff(cv::Mat1f(8, 8, 0.5F)), kPhotometric), kBlackIsZero);
  EXPECT_EQ(field_of(encode_tiff(cv::Mat3f(8, 8)), kPhotometric), kRgb);
}

TEST(Tiff, RefusesOtherTypes) {
  EXPECT_THROW((void)encode_tiff(cv::Mat1b(8, 8)), std::invalid_argument);
  EXPECT_THROW((void)encode_tiff(cv::Mat1f()), std::invalid_argument);
}

}  // namespace
}  // namespace saccade
