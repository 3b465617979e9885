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

TEST(Tiff, RefusesOtherTypes) {
  EXPECT_THROW((void)encode_tiff(cv::Mat1b(8, 8)), std::invalid_argument);
  EXPECT_THROW((void)encode_tiff(cv::Mat1f()), std::invalid_argument);
}

}  // namespace
}  // namespace saccade
