#include "comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shapes.hpp"

namespace saccade::test {
namespace {

double share_above(const cv::Mat1d& errors, double limit) {
  return static_cast<double>(
             std::count_if(errors.begin(), errors.end(), [&](double e) { return e > limit; })) /
         static_cast<double>(errors.total());
}

cv::Mat1d difference(const cv::Mat1d& expected, const cv::Mat1f& actual) {
  cv::Mat1d errors(expected.size());
  for (int r = 0; r < errors.rows; ++r)
    for (int c = 0; c < errors.cols; ++c) {
      const double value = static_cast<double>(actual(r, c));
      EXPECT_TRUE(std::isfinite(value) && value >= 0) << value << " at row " << r << ", column " << c;
      errors(r, c) = std::abs(expected(r, c) - value);
    }
  return errors;
}

}  // namespace

std::vector<std::string> runnable_simd() {
  std::vector<std::string> runnable;
  WorkerPool pool(1);
  for (const char* simd : {"scalar", "sse4", "neon", "avx2", "avx512"}) {
    try {
      const Symmetry3d probe(Symmetry3dParams(), pool, simd);
      runnable.emplace_back(simd);
    } catch (const Error&) {  // not on this machine
    }
  }
  return runnable;
}

// How far the float form may turn an axis, in radians: the uncertainty of the covariance divided by the
// distance to the next eigenvalue. Normals are exact to 1e-7 each and summed in units of 2^-23, rotations
// exact to 5e-7.
std::array<double, 3> axis_uncertainty(const Eigen::Vector3d& e) {
  const double covariance = 1e-8 + 5e-7 * e[2], low = e[1] - e[0], high = e[2] - e[1];
  return {1e-6 + covariance / low, 1e-6 + covariance / std::min(low, high), 1e-6 + covariance / high};
}

namespace {

using Scores = std::array<std::vector<double>, 3>;  // of each plane

// Adds the score of plane i with the points of `level`; two scores where its gate may be open or shut.
void add_scores(const reference::Level& level, int row, int col, const Symmetry3dParams& params,
                std::size_t i, Scores& scores) {
  constexpr double kGate = 1e-5;
  const auto pixel = reference::symmetry_at(level, row, col, params);
  if (!pixel) return;
  const reference::PlaneSymmetry& plane = pixel->planes[i];
  scores[i].push_back(plane.score);
  if (std::min(std::abs(plane.cos_1), std::abs(plane.cos_2)) < kGate) scores[i].push_back(0);
  if (plane.score == 0 && plane.cos_1 > -kGate && plane.cos_2 < kGate) {
    const double lambda_mm = params.length_scale == LengthScale::millimetre
                                 ? 1
                                 : 0.05 * params.kernel * level.depth_mm(row, col) / level.camera.fx;
    scores[i].push_back(std::exp(-(plane.delta_D_mm + plane.delta_d_mm) / lambda_mm) * plane.omega_1 *
                        plane.omega_2);
  }
}

// The other points of the window whose side of a plane depends on the last bits.
std::vector<cv::Point> points_nearly_on(const reference::Level& level, int row, int col, int reach,
                                        const Eigen::Vector3d& gamma, double uncertainty) {
  std::vector<cv::Point> points;
  const cv::Vec3d p = level.points_mm(row, col);
  for (int r = std::max(0, row - reach); r <= std::min(level.normals.rows - 1, row + reach); ++r)
    for (int c = std::max(0, col - reach); c <= std::min(level.normals.cols - 1, col + reach); ++c) {
      if (level.normals(r, c) == cv::Vec3d() || (r == row && c == col)) continue;
      const cv::Vec3d offset = level.points_mm(r, c) - p;
      const double d = gamma[0] * offset[0] + gamma[1] * offset[1] + gamma[2] * offset[2];
      if (std::abs(d) <= uncertainty * cv::norm(offset)) points.emplace_back(c, r);
    }
  return points;
}

}  // namespace

Answer judge(const reference::Level& level, int row, int col, const Symmetry3dParams& params, double actual,
             double tolerance) {
  constexpr std::size_t kMostPoints = 8;  // 256 ways
  const auto pixel = reference::symmetry_at(level, row, col, params);
  if (!pixel) return actual == 0 ? Answer::right : Answer::wrong;
  if (std::abs(actual - pixel->score()) <= tolerance) return Answer::right;
  const auto uncertainty = axis_uncertainty(pixel->eigenvalues);
  reference::Level moved = level;
  moved.points_mm = level.points_mm.clone();
  Scores scores;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& gamma = pixel->planes[i].gamma;
    const auto points = points_nearly_on(level, row, col, params.kernel / 2, gamma, uncertainty[i]);
    if (points.size() > kMostPoints) return Answer::undefined;
    for (unsigned sides = 0; sides < 1u << points.size(); ++sides) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        const cv::Vec3d offset = level.points_mm(points[j]) - level.points_mm(row, col);
        const double shift = ((sides >> j & 1u) ? 2 : -2) * uncertainty[i] * cv::norm(offset);
        moved.points_mm(points[j]) =
            level.points_mm(points[j]) + shift * cv::Vec3d(gamma[0], gamma[1], gamma[2]);
      }
      add_scores(moved, row, col, params, i, scores);
    }
    for (const cv::Point& point : points) moved.points_mm(point) = level.points_mm(point);
  }
  // Some plane has the answer among its scores, and each plane has a score that is not above it.
  bool given = false;
  for (const auto& plane : scores) {
    if (*std::min_element(plane.begin(), plane.end()) > actual + tolerance) return Answer::wrong;
    given = given || std::any_of(plane.begin(), plane.end(),
                                 [&](double score) { return std::abs(score - actual) <= tolerance; });
  }
  return given ? Answer::near_tie : Answer::wrong;
}

Comparison::Comparison(const cv::Mat1f& depth, const Intrinsics& intrinsics, const Symmetry3dParams& p)
    : expected(reference::symmetry3d(depth, intrinsics, p)), params(p), depth_mm(depth), camera(intrinsics) {
  cv::Mat1d level_depth = to_double(depth);
  for (int l = 0; l <= params.last_level; ++l) {
    if (l > 0) level_depth = reference::halve(level_depth);
    if (l >= params.first_level) levels.push_back(reference::make_level(level_depth, camera.at_level(l)));
  }
}

void Comparison::check(const std::string& simd, double excused, double noticed) const {
  SCOPED_TRACE("k = " + std::to_string(params.kernel) + ", simd = " + simd);
  WorkerPool pool(2);
  Symmetry3d op(params, pool, simd);
  SaliencyMaps maps;
  StageTimes times;
  op.compute(depth_mm, camera, {.levels = true}, maps, times);
  ASSERT_EQ(maps.master.size(), depth_mm.size());
  ASSERT_EQ(maps.levels.size(), expected.levels.size());
  for (std::size_t i = 0; i < maps.levels.size(); ++i) check_level(i, maps.levels[i], noticed);

  const cv::Mat1d errors = difference(expected.master, maps.master);
  double maximum = 0;
  cv::minMaxLoc(expected.master, nullptr, &maximum);
  EXPECT_LE(share_above(errors, 0.01 * maximum), 0.005);
  EXPECT_LE(share_above(errors, noticed), excused);
}

void Comparison::check_level(std::size_t i, const cv::Mat1f& actual, double noticed) const {
  ASSERT_EQ(actual.size(), expected.levels[i].size());
  const cv::Mat1d errors = difference(expected.levels[i], actual);
  int undefined = 0;
  for (int r = 0; r < errors.rows; ++r)
    for (int c = 0; c < errors.cols; ++c) {
      if (errors(r, c) <= noticed) continue;
      // Moved points and a turned axis change a score a little more.
      const Answer answer = judge(levels[i], r, c, params, static_cast<double>(actual(r, c)), 10 * noticed);
      undefined += answer == Answer::undefined;
      EXPECT_NE(answer, Answer::wrong) << "level " << i << " of the list, row " << r << ", column " << c
                                       << ": " << actual(r, c) << " instead of " << expected.levels[i](r, c);
    }
  EXPECT_LE(undefined, std::max(1, static_cast<int>(errors.total() / 1000)));
}

}  // namespace saccade::test
