#include "output/overlay.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

class OverlayTest : public ::testing::Test {
 protected:
  OverlayTest() {
    frame_.depth_mm = cv::Mat1f(120, 160, 1000.0F);
    frame_.colour = cv::Mat3b(120, 160, cv::Vec3b(40, 50, 60));
    attention_.fixations.push_back({60, 80, 1, {}, {}});
    attention_.masks = cv::Mat1w(120, 160, std::uint16_t{0});
    attention_.masks(cv::Rect(20, 20, 10, 10)) = 1;
  }
  Frame frame_;
  Attention attention_;
  cv::Mat1f saliency_ = cv::Mat1f(120, 160, 0.0F);
};

TEST_F(OverlayTest, LeavesPixelsThatAreNotSalientAsTheyWere) {
  const cv::Mat3b picture = draw_overlay(frame_, saliency_, attention_);
  EXPECT_EQ(picture(100, 10), cv::Vec3b(40, 50, 60));
  EXPECT_EQ(frame_.colour(60, 80), cv::Vec3b(40, 50, 60)) << "the frame itself is not drawn on";
}

// Each object in its own mask of the whole picture, closed and traced.
std::vector<Outline> slow_outlines(const Attention& attention) {
  std::vector<Outline> outlines;
  const cv::Mat brush = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  for (std::size_t rank = attention.fixations.size(); rank > 0; --rank) {
    cv::Mat1b mask;
    cv::compare(attention.masks, static_cast<double>(rank), mask, cv::CMP_EQ);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, brush);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
    for (auto& points : contours) outlines.push_back({rank, std::move(points)});
  }
  return outlines;
}

TEST_F(OverlayTest, OutlinesEqualThoseOfTheWholeMasks) {
  cv::RNG random(7);
  for (int round = 0; round < 20; ++round) {
    attention_.fixations.assign(6, attention_.fixations.front());
    attention_.masks.setTo(0);
    for (int i = 0; i < 40;
         ++i) {  // objects of several parts, some at the border; rank 6 has no pixels, 7 no fixation
      const cv::Rect part(random.uniform(-10, 150), random.uniform(-10, 110), random.uniform(1, 25),
                          random.uniform(1, 25));
      const int rank = random.uniform(0, 7);
      attention_.masks(part & cv::Rect(0, 0, 160, 120)) = static_cast<std::uint16_t>(rank == 6 ? 7 : rank);
    }
    const std::vector<Outline> expected = slow_outlines(attention_), found = proto_outlines(attention_);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].rank, expected[i].rank);
      EXPECT_EQ(found[i].points, expected[i].points);
    }
  }
}

TEST_F(OverlayTest, MarksFixationsOutlinesObjectsAndColoursTheMap) {
  saliency_(100, 140) = 2;
  const cv::Mat3b picture = draw_overlay(frame_, saliency_, attention_);
  EXPECT_NE(picture(60, 74), cv::Vec3b(40, 50, 60)) << "the mark's disc";
  EXPECT_NE(picture(20, 25), cv::Vec3b(40, 50, 60)) << "the outline";
  EXPECT_EQ(picture(25, 25), cv::Vec3b(40, 50, 60)) << "not the inside";
  EXPECT_GT(picture(100, 140)[2], 60) << "red is most salient";

  OverlayStyle plain;
  plain.marks = plain.outlines = plain.path = false;
  plain.map.opacity = 0;
  EXPECT_EQ(cv::norm(draw_overlay(frame_, saliency_, attention_, plain), frame_.colour), 0);
}

// The default overlay by its definition, pixel by pixel.
cv::Mat3b slow_overlay(const cv::Mat3b& background, const cv::Mat1f& saliency, double opacity) {
  cv::Mat1f smooth;
  cv::GaussianBlur(saliency, smooth, {}, std::max(1.0, saliency.cols / 200.0));
  double largest = 0;
  cv::minMaxLoc(smooth, nullptr, &largest);
  cv::Mat1f root;
  cv::sqrt(smooth / largest, root);
  cv::Mat1b level;
  root.convertTo(level, CV_8U, 255);
  cv::Mat3b colours, picture = background.clone();
  cv::applyColorMap(level, colours, cv::COLORMAP_TURBO);
  for (int r = 0; r < picture.rows; ++r)
    for (int c = 0; c < picture.cols; ++c) {
      const int a = cvRound(opacity * level(r, c));
      for (int i = 0; i < 3; ++i)
        picture(r, c)[i] =
            static_cast<std::uint8_t>((picture(r, c)[i] * (255 - a) + colours(r, c)[i] * a + 127) / 255);
    }
  return picture;
}

TEST_F(OverlayTest, TheFastBlendFollowsTheDefinition) {
  cv::theRNG().state = 7;
  cv::randu(saliency_, 0, 3.7);
  cv::randu(frame_.colour, 0, 256);
  const OverlayStyle style{.map = {.opacity = 0.63}, .outlines = false, .marks = false, .path = false};
  EXPECT_EQ(cv::norm(draw_overlay(frame_, saliency_, attention_, style),
                     slow_overlay(frame_.colour, saliency_, 0.63), cv::NORM_INF),
            0);
}

TEST(ShownStrength, RangeThresholdAndRoot) {
  const cv::Mat1f map = (cv::Mat1f(1, 5) << 0, 1, 2, 3, 9);
  MapStyle style;
  EXPECT_EQ(shown_range(map, style), (ValueRange{0, 9}));
  EXPECT_EQ(shown_strength(map, style)(4), 255);
  EXPECT_EQ(shown_strength(map, style)(1), 85) << "255 * sqrt(1/9)";

  style.range = ValueRange{1, 5};
  const cv::Mat1b locked = shown_strength(map, style);
  EXPECT_EQ(locked(0), 0) << "below the range";
  EXPECT_EQ(locked(1), 0);
  EXPECT_EQ(locked(2), 128) << "255 * sqrt(1/4)";
  EXPECT_EQ(locked(4), 255) << "above the range";

  style.threshold = 0.4;
  EXPECT_EQ(shown_strength(map, style)(2), 0) << "at a quarter of the range";
  EXPECT_EQ(shown_strength(map, style)(3), 180) << "at half of it";

  style.range = ValueRange{2, 2};
  EXPECT_EQ(cv::countNonZero(shown_strength(map, style)), 0) << "an empty range shows nothing";
  EXPECT_EQ(cv::countNonZero(shown_strength(cv::Mat1f(4, 4, 0.0F), MapStyle{})), 0);
}

TEST_F(OverlayTest, PaletteBackgroundAndPathAreChoices) {
  saliency_(100, 140) = 2;
  attention_.fixations.push_back({20, 80, 0.5F, {}, {}});
  const cv::Vec3b turbo = draw_overlay(frame_, saliency_, attention_)(100, 140);
  const cv::Vec3b grey =
      draw_overlay(frame_, saliency_, attention_, {.map = {.palette = Palette::grey}})(100, 140);
  EXPECT_NE(turbo, grey);
  EXPECT_GT(grey[0], 150);

  const OverlayStyle depth{.background = Background::depth, .map = {.opacity = 0}, .path = false};
  const cv::Mat3b picture = draw_overlay(frame_, saliency_, attention_, depth);
  EXPECT_EQ(picture(100, 10), depth_picture(frame_.depth_mm)(100, 10));
  EXPECT_EQ(picture(40, 80), picture(100, 10)) << "no path between the marks";
  EXPECT_NE(draw_overlay(frame_, saliency_, attention_)(40, 80), cv::Vec3b(40, 50, 60)) << "the path";
}

TEST_F(OverlayTest, MarksAtTheEdgeOfTheImageAreWhole) {
  const auto marked = [&](int row, int col) {
    attention_.fixations[0].row = row;
    attention_.fixations[0].col = col;
    const cv::Mat3b picture = draw_overlay(frame_, saliency_, attention_, {.outlines = false});
    return cv::norm(picture, frame_.colour, cv::NORM_L1);
  };
  const double whole = marked(60, 80);
  for (const auto& [row, col] : {std::pair(0, 0), {0, 80}, {119, 159}, {60, 159}, {119, 3}})
    EXPECT_EQ(marked(row, col), whole) << row << ' ' << col;
}

TEST_F(OverlayTest, ADoubtfulFixationIsGreyWithItsOutline) {
  const auto drawn = [&](std::optional<float> confidence) {
    attention_.fixations[0].confidence = confidence;
    return draw_overlay(frame_, saliency_, attention_, {.path = false});
  };
  const cv::Mat3b sure = drawn(0.9F), doubtful = drawn(0.3F);
  EXPECT_EQ(cv::norm(drawn(std::nullopt), sure, cv::NORM_INF), 0);
  const cv::Rect outline(10, 10, 30, 30), mark(60, 40, 40, 40);
  EXPECT_GT(cv::norm(sure(outline), doubtful(outline), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(sure(mark), doubtful(mark), cv::NORM_INF), 0);
  for (const cv::Vec3b& p : doubtful) EXPECT_LE(p[1] - p[2], 1) << "nothing is green";
}

TEST_F(OverlayTest, SizesThatDoNotFitAreRefused) {
  cv::Mat3b picture(3, 3);
  EXPECT_THROW(blend_map(picture, cv::Mat1b(3, 4), {}), std::invalid_argument);
}

TEST_F(OverlayTest, DepthReplacesMissingColour) {
  frame_.colour.release();
  EXPECT_EQ(draw_overlay(frame_, saliency_, attention_).size(), cv::Size(160, 120));
}

}  // namespace
}  // namespace saccade
