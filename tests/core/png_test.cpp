#include "core/png.hpp"

#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace saccade {
namespace {

template <typename Image>
Image noise(cv::Size size) {
  Image image(size);
  cv::theRNG().state = 7;
  cv::randu(image, cv::Scalar::all(0), cv::Scalar::all(65536));
  return image;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(Png, RoundTripIsExactAlsoWithOpenCvAsTheReader) {
  for (const cv::Mat& image :
       {cv::Mat(noise<cv::Mat1b>({37, 21})), cv::Mat(noise<cv::Mat1w>({37, 21})),
        cv::Mat(noise<cv::Mat3b>({37, 21})), cv::Mat(noise<cv::Mat1w>({40, 30})(cv::Rect(3, 4, 20, 11)))}) {
    const auto png = encode_png(image);
    EXPECT_TRUE(same(decode_png(png), image));
    EXPECT_TRUE(same(cv::imdecode(png, cv::IMREAD_UNCHANGED), image));
    EXPECT_EQ(read_png_header(png).size, image.size());
  }
}

TEST(Png, LargePicturesAndWideOnesAreExactToo) {
  cv::Mat3b half_flat(300, 400, cv::Vec3b(1, 2, 3));
  noise<cv::Mat3b>({200, 300}).copyTo(half_flat.colRange(100, 300));
  cv::Mat1w ramp(300, 400);
  for (int r = 0; r < ramp.rows; ++r)
    for (int c = 0; c < ramp.cols; ++c) ramp(r, c) = static_cast<std::uint16_t>(r < 100 ? 0 : r * c);
  for (const cv::Mat& image : {cv::Mat(half_flat), cv::Mat(ramp), cv::Mat(noise<cv::Mat3b>({8000, 20}))}) {
    const auto png = encode_png(image);
    EXPECT_TRUE(same(decode_png(png), image));
    EXPECT_TRUE(same(cv::imdecode(png, cv::IMREAD_UNCHANGED), image));
  }
}

TEST(Png, ReadsFilesOfOpenCv) {
  for (const cv::Mat& image : {cv::Mat(noise<cv::Mat1b>({33, 9})), cv::Mat(noise<cv::Mat1w>({33, 9})),
                               cv::Mat(noise<cv::Mat3b>({33, 9}))}) {
    std::vector<std::uint8_t> png;
    cv::imencode(".png", image, png);
    EXPECT_TRUE(same(decode_png(png), image));
  }
}

TEST(Png, OneBitPicturesAreUnpackedNotScaled) {
  const cv::Mat1b image =
      (cv::Mat1b(2, 11) << 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 1);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", image * 255, png, {cv::IMWRITE_PNG_BILEVEL, 1});
  ASSERT_EQ(read_png_header(png).bits, 1);
  EXPECT_TRUE(same(decode_png(png), image));
}

TEST(Png, DamageIsAnErrorAtEveryByte) {
  const auto png = encode_png(noise<cv::Mat1w>({16, 16}));
  for (std::size_t size = 0; size + 12 < png.size(); ++size)
    EXPECT_THROW((void)decode_png(std::span(png).first(size)), std::runtime_error) << size;
}

TEST(Png, RefusesOtherTypes) { EXPECT_THROW((void)encode_png(cv::Mat1f(8, 8)), std::invalid_argument); }

}  // namespace
}  // namespace saccade
