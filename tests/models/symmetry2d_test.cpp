// symmetry2d and colour_symmetry2d against their formulas, written down pair by pair in double.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "displays.hpp"
#include "models/mirror_pairs.hpp"

namespace saccade {
namespace {

constexpr double kPi = std::numbers::pi;

struct Gradient {
  double m = 0, t = 0;
};

// Position i of a line of n pixels, reflected at its ends without repeating them.
int reflect(int i, int n) { return n == 1 ? 0 : i < 0 ? -i : i >= n ? 2 * (n - 1) - i : i; }

cv::Mat1d halve(const cv::Mat1d& image) {
  const double w[5] = {1, 4, 6, 4, 1};
  cv::Mat1d half((image.rows + 1) / 2, (image.cols + 1) / 2, 0.0);
  for (int r = 0; r < half.rows; ++r)
    for (int c = 0; c < half.cols; ++c)
      for (int v = -2; v <= 2; ++v)
        for (int u = -2; u <= 2; ++u)
          half(r, c) += w[v + 2] * w[u + 2] / 256 *
                        image(reflect(2 * r + v, image.rows), reflect(2 * c + u, image.cols));
  return half;
}

Gradient sobel(const cv::Mat1d& image, int r, int c) {
  const auto at = [&](int v, int u) { return image(reflect(r + v, image.rows), reflect(c + u, image.cols)); };
  const double gx = at(-1, 1) + 2 * at(0, 1) + at(1, 1) - at(-1, -1) - 2 * at(0, -1) - at(1, -1);
  const double gy = at(1, -1) + 2 * at(1, 0) + at(1, 1) - at(-1, -1) - 2 * at(-1, 0) - at(-1, 1);
  return {std::hypot(gx, gy), std::atan2(gy, gx)};
}

using Angles = double (*)(double ti, double tj, double alpha);

double isotropic(double ti, double tj, double alpha) {
  return (1 - std::cos(ti + tj - 2 * alpha)) * (1 - std::cos(ti - tj));
}

double heidemann(double ti, double tj, double alpha) {
  const auto square = [](double x) { return x * x; };
  const double gi = ti - alpha, gj = tj - alpha;
  return square(std::cos(gi + gj)) * square(std::cos(gi)) * square(std::cos(gj));
}

// The score of one level: the sum over pairs of pixels and pairs of channels.
double symmetry_at(const std::vector<cv::Mat1d>& channels, int r, int c, Angles angles) {
  constexpr double kSigma = 16;
  const int rows = channels[0].rows, cols = channels[0].cols;
  double sum = 0;
  for (int dy = -5; dy <= 5; ++dy)
    for (int dx = -5; dx <= 5; ++dx) {
      if (std::abs(dy) <= 2 && std::abs(dx) <= 2) continue;
      const int ri = r + dy, ci = c + dx, rj = r - dy, cj = c - dx;
      if (std::min({ri, ci, rj, cj}) < 0 || std::max(ri, rj) >= rows || std::max(ci, cj) >= cols) continue;
      const double distance = 2 * std::hypot(dy, dx), alpha = std::atan2(dy, dx);
      const double weight =
          std::exp(-distance * distance / (2 * kSigma * kSigma)) / (kSigma * std::sqrt(2 * kPi));
      for (const cv::Mat1d& k : channels)
        for (const cv::Mat1d& l : channels) {
          const Gradient i = sobel(k, ri, ci), j = sobel(l, rj, cj);
          sum += angles(i.t, j.t, alpha) * std::log(1 + i.m) * std::log(1 + j.m) * weight;
        }
    }
  return sum / 2;  // each pair was seen from both ends
}

double interpolate(const cv::Mat1d& image, double r, double c) {
  const int r0 = std::min(static_cast<int>(r), image.rows - 1), r1 = std::min(r0 + 1, image.rows - 1);
  const int c0 = std::min(static_cast<int>(c), image.cols - 1), c1 = std::min(c0 + 1, image.cols - 1);
  const double v = r - std::floor(r), u = c - std::floor(c);
  return (1 - v) * ((1 - u) * image(r0, c0) + u * image(r0, c1)) +
         v * ((1 - u) * image(r1, c0) + u * image(r1, c1));
}

cv::Mat1d reference(std::vector<cv::Mat1d> channels, Angles angles) {
  cv::Mat1d sum(channels[0].size(), 0.0);
  for (int l = 1; l <= 5; ++l) {
    for (cv::Mat1d& channel : channels) channel = halve(channel);
    cv::Mat1d level(channels[0].size());
    for (int r = 0; r < level.rows; ++r)
      for (int c = 0; c < level.cols; ++c) level(r, c) = symmetry_at(channels, r, c, angles);
    for (int r = 0; r < sum.rows; ++r)
      for (int c = 0; c < sum.cols; ++c)
        sum(r, c) += interpolate(level, r / std::pow(2, l), c / std::pow(2, l));
  }
  return sum;
}

void expect_near(const cv::Mat1f& map, const cv::Mat1d& expected) {
  double highest = 0;
  cv::minMaxLoc(expected, nullptr, &highest);
  ASSERT_GT(highest, 0);
  EXPECT_LT(cv::norm(as_double(map), expected, cv::NORM_INF), 1e-3 * highest) << "of " << highest;
}

TEST(Symmetry2d, IsTheSumOverPairs) {
  for (const cv::Size size : {cv::Size(64, 48), cv::Size(75, 53), cv::Size(31, 90)}) {
    const cv::Mat3b image = noise_image(size);
    cv::Mat1b grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    expect_near(map_of("symmetry2d", frame_of(image)), reference({as_double(grey, 1.0 / 255)}, isotropic));
  }
}

TEST(ColourSymmetry2d, IsTheSumOverPairsOfPixelsAndChannels) {
  for (const cv::Size size : {cv::Size(64, 48), cv::Size(53, 41)}) {
    const cv::Mat3b image = noise_image(size);
    std::vector<cv::Mat1b> bytes;
    cv::split(image, bytes);
    std::vector<cv::Mat1d> channels;
    for (const cv::Mat1b& channel : bytes) channels.push_back(as_double(channel, 1.0 / 255));
    expect_near(map_of("colour_symmetry2d", frame_of(image)), reference(channels, heidemann));
  }
}

TEST(MirrorPairs, AreEachPairOfTheRingOnce) {
  const auto pairs = mirror_pairs();
  EXPECT_EQ(pairs.size(), (11U * 11 - 5 * 5) / 2);
  for (const MirrorPair& pair : pairs) {
    EXPECT_TRUE(std::abs(pair.dx) > 2 || std::abs(pair.dy) > 2);
    for (const MirrorPair& other : pairs) EXPECT_FALSE(pair.dx == -other.dx && pair.dy == -other.dy);
  }
}

TEST(Symmetry2d, IsHighestInTheMiddleOfABlobAndOfABar) {
  for (const char* model : {"symmetry2d", "colour_symmetry2d"}) {
    cv::Mat3b blob(240, 320, cv::Vec3b(200, 200, 200));
    cv::circle(blob, {150, 110}, 14, {40, 40, 40}, cv::FILLED, cv::LINE_AA);
    const cv::Point at = maximum_of(map_of(model, frame_of(blob)));
    EXPECT_LT(std::hypot(at.x - 150, at.y - 110), 4) << model << at;

    cv::Mat3b bar(240, 320, cv::Vec3b(20, 20, 20));
    bar(cv::Rect(100, 40, 16, 160)) = cv::Vec3b(220, 220, 220);
    EXPECT_NEAR(maximum_of(map_of(model, frame_of(bar))).x, 107.5, 4) << model;
  }
}

TEST(Symmetry2d, FindsTheFieldsOfACheckerboardAndNotItsEdges) {
  cv::Mat3b board(256, 256);
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.cols; ++c)
      board(r, c) = (r / 32 + c / 32) % 2 ? cv::Vec3b(230, 230, 230) : cv::Vec3b(25, 25, 25);
  const cv::Mat1f map = map_of("symmetry2d", frame_of(board));
  // In the middle of a field all edges around face each other; in the middle of an edge they do not.
  for (int i = 2; i < 5; ++i) {
    EXPECT_GT(map(32 * i + 16, 32 * i + 16), 1.2F * map(32 * i + 16, 32 * i));
    EXPECT_GT(map(32 * i + 16, 32 * i + 16), 1.2F * map(32 * i, 32 * i + 16));
  }
}

TEST(ColourSymmetry2d, SeesWhatIsEquallyBright) {
  // Two colours of one grey: 0.299 R + 0.587 G + 0.114 B is 76 for both.
  cv::Mat3b image(120, 160, cv::Vec3b(0, 0, 255));
  cv::circle(image, {80, 60}, 14, {0, 130, 0}, cv::FILLED);
  double grey = 0, colour = 0;
  cv::minMaxLoc(map_of("symmetry2d", frame_of(image)), nullptr, &grey);
  const cv::Mat1f map = map_of("colour_symmetry2d", frame_of(image));
  cv::minMaxLoc(map, nullptr, &colour);
  EXPECT_EQ(grey, 0);
  EXPECT_GT(colour, 0.1);
  const cv::Point at = maximum_of(map);
  EXPECT_LT(std::hypot(at.x - 80, at.y - 60), 4) << at;
}

}  // namespace
}  // namespace saccade
