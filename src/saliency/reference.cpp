#include "saliency/reference.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

// In the order of README.md in this folder.
namespace saccade::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d at(const cv::Mat3d& image, int row, int col) {
  const cv::Vec3d& v = image(row, col);
  return {v[0], v[1], v[2]};
}

// Position `i` of a line of `n` pixels, reflected at its ends without repeating them.
int reflect(int i, int n) {
  if (i >= 0 && i < n) return i;
  if (n == 1) return 0;
  const int period = 2 * (n - 1);
  const int m = ((i % period) + period) % period;
  return m < n ? m : period - m;
}

}  // namespace

// Section 1.2
cv::Mat1d halve(const cv::Mat1d& depth) {
  constexpr std::array<double, 5> kBinomial = {1, 4, 6, 4, 1};
  cv::Mat1d half((depth.rows + 1) / 2, (depth.cols + 1) / 2, 0.0);
  for (int r = 0; r < half.rows; ++r)
    for (int c = 0; c < half.cols; ++c) {
      if (depth(2 * r, 2 * c) == 0) continue;  // an invalid even pixel stays invalid
      double sum = 0, weights = 0;
      for (int v = -2; v <= 2; ++v)
        for (int u = -2; u <= 2; ++u) {
          const double z = depth(reflect(2 * r + v, depth.rows), reflect(2 * c + u, depth.cols));
          const double weight =
              kBinomial[static_cast<std::size_t>(v + 2)] * kBinomial[static_cast<std::size_t>(u + 2)];
          if (z == 0) continue;
          sum += weight * z;
          weights += weight;
        }
      half(r, c) = std::round(8 * sum / weights) / 8;
    }
  return half;
}

namespace {

// Section 1.3: fits 1/z = a*x + b*y + c to the pixels of the 5 x 5 window that continue the surface.
std::optional<Vector3d> normal_at(const cv::Mat1d& depth, const Intrinsics& camera, int row, int col) {
  constexpr int kReach = 2;
  constexpr double kSameSurface = 0.02;
  const double z0 = depth(row, col);
  if (z0 == 0) return std::nullopt;
  // Offsets u and v are integers, so that the test for "all on one line" is exact.
  double n = 0, sum_u = 0, sum_v = 0, sum_uu = 0, sum_vv = 0, sum_uv = 0, sum_w = 0, sum_uw = 0, sum_vw = 0;
  for (int v = -kReach; v <= kReach; ++v)
    for (int u = -kReach; u <= kReach; ++u) {
      const int r = row + v, c = col + u;
      if (r < 0 || c < 0 || r >= depth.rows || c >= depth.cols) continue;
      const double z = depth(r, c);
      if (z == 0 || std::abs(z - z0) > kSameSurface * z0) continue;
      const double w = 1 / z - 1 / z0;  // relative to the centre, against cancellation
      n += 1, sum_u += u, sum_v += v, sum_uu += u * u, sum_vv += v * v, sum_uv += u * v;
      sum_w += w, sum_uw += u * w, sum_vw += v * w;
    }
  const double uu = n * sum_uu - sum_u * sum_u, vv = n * sum_vv - sum_v * sum_v,
               uv = n * sum_uv - sum_u * sum_v;
  const double determinant = uu * vv - uv * uv;
  if (n < 3 || determinant == 0) return std::nullopt;
  const double uw = n * sum_uw - sum_u * sum_w, vw = n * sum_vw - sum_v * sum_w;
  const double slope_u = (uw * vv - vw * uv) / determinant, slope_v = (vw * uu - uw * uv) / determinant;
  const double at_centre = 1 / z0 + (sum_w - slope_u * sum_u - slope_v * sum_v) / n;
  const double a = slope_u * camera.fx, b = slope_v * camera.fy;
  const double c = at_centre - slope_u * (col - camera.cx) - slope_v * (row - camera.cy);
  return -Vector3d(a, b, c).normalized();
}

}  // namespace

// Sections 1.1 and 1.3
Level make_level(const cv::Mat1d& depth, const Intrinsics& camera) {
  Level level{depth, cv::Mat3d(depth.size(), cv::Vec3d()), cv::Mat3d(depth.size(), cv::Vec3d()), camera};
  for (int r = 0; r < depth.rows; ++r)
    for (int c = 0; c < depth.cols; ++c) {
      const cv::Point3d p = camera.point_mm(r, c, depth(r, c));
      level.points_mm(r, c) = {p.x, p.y, p.z};
      if (const auto n = normal_at(depth, camera, r, c)) level.normals(r, c) = {n->x(), n->y(), n->z()};
    }
  return level;
}

namespace {

// The valid pixels of a window, the centre among them.
struct Window {
  std::vector<Vector3d> points, normals;
};

Window window_at(const Level& level, int row, int col, int reach) {
  Window window;
  for (int r = std::max(0, row - reach); r <= std::min(level.normals.rows - 1, row + reach); ++r)
    for (int c = std::max(0, col - reach); c <= std::min(level.normals.cols - 1, col + reach); ++c)
      if (level.normals(r, c) != cv::Vec3d()) {
        window.points.push_back(at(level.points_mm, r, c));
        window.normals.push_back(at(level.normals, r, c));
      }
  return window;
}

// Section 2.1: the axes of the Extended Gaussian Image are the normals of the candidate planes.
Eigen::SelfAdjointEigenSolver<Matrix3d> gaussian_image_axes(const std::vector<Vector3d>& normals) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& n : normals) mean += n;
  mean /= static_cast<double>(normals.size());
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& n : normals) covariance += (n - mean) * (n - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance / static_cast<double>(normals.size()));
}

// Section 2.4
double lambda_mm_at(const Level& level, int row, int col, const Symmetry3dParams& params) {
  const std::optional<double> lambda_px = params.lambda_px();
  return lambda_px ? *lambda_px * level.depth_mm(row, col) / level.camera.fx : 1;
}

// Sums over the points on one side of a plane.
struct Half {
  double count = 0;
  Vector3d point = Vector3d::Zero(), normal = Vector3d::Zero();
};

// Eq. (2): the window's points by the sign of their distance to the plane; those on it are in neither half.
std::array<Half, 2> halves_of(const Window& window, const Vector3d& p, const Vector3d& gamma) {
  std::array<Half, 2> halves;  // the paper's ' and ''
  for (std::size_t j = 0; j < window.points.size(); ++j) {
    const double d = gamma.dot(window.points[j] - p);
    if (d == 0) continue;
    Half& half = halves[d > 0 ? 0 : 1];
    half.count += 1;
    half.point += window.points[j];
    half.normal += window.normals[j];
  }
  return halves;
}

// Sections 2.2 to 2.8 for one plane through p.
PlaneSymmetry symmetry_of_plane(const Window& window, const Vector3d& p, const Vector3d& gamma,
                                double lambda_mm) {
  PlaneSymmetry result;
  result.gamma = gamma;
  const auto [front, back] = halves_of(window, p, gamma);
  if (front.count == 0 || back.count == 0) return result;
  // Eq. (5)
  const Vector3d p1 = front.point / front.count;
  // Eq. (6)
  const Vector3d p2 = back.point / back.count;
  result.verdict = PlaneVerdict::no_direction;
  if (front.normal.isZero(0) || back.normal.isZero(0) || p1 == p2) return result;
  // Eq. (9)
  const Vector3d l = (p1 - p2).normalized();
  // Eq. (10)
  const Vector3d n1 = front.normal.normalized();
  // Eq. (11)
  const Vector3d n2 = back.normal.normalized();

  // Eq. (4)
  result.delta_D_mm = std::abs(p1.z() - p2.z());
  // Eq. (7)
  result.delta_d_mm = std::abs(std::abs(gamma.dot(p1 - p)) - std::abs(gamma.dot(p2 - p)));
  // Eq. (8), with N normalised: as printed, omega_1 would vanish for exactly opposite normals.
  const Vector3d cross = n1.cross(n2);
  result.omega_1 = cross.isZero(0) ? 0 : cross.normalized().cross(l).norm();
  // Eq. (12)
  result.cos_1 = n1.dot(l);
  result.cos_2 = n2.dot(l);
  const double a1 = std::acos(std::clamp(result.cos_1, -1.0, 1.0)),
               a2 = std::acos(std::clamp(result.cos_2, -1.0, 1.0));
  result.omega_2 = (1 - std::cos(a1 + a2)) * (1 - std::cos(a1 - a2));
  // Eq. (14), as meant: the normals lean away from the plane. As printed it also erases convex patches.
  result.verdict = PlaneVerdict::not_convex;
  if (!(result.cos_1 > 0 && result.cos_2 < 0)) return result;
  result.verdict = cross.isZero(0) ? PlaneVerdict::flat : PlaneVerdict::scores;
  // Eq. (3), Eq. (13)
  result.score =
      std::exp(-(result.delta_D_mm + result.delta_d_mm) / lambda_mm) * result.omega_1 * result.omega_2;
  return result;
}

}  // namespace

// Section 2
std::optional<PixelSymmetry> symmetry_at(const Level& level, int row, int col,
                                         const Symmetry3dParams& params) {
  if (level.normals(row, col) == cv::Vec3d()) return std::nullopt;
  const Window window = window_at(level, row, col, params.reach());
  const auto axes = gaussian_image_axes(window.normals);
  const Vector3d p = at(level.points_mm, row, col);
  const double lambda_mm = lambda_mm_at(level, row, col, params);
  PixelSymmetry pixel;
  pixel.eigenvalues = axes.eigenvalues();
  for (int i = 0; i < 3; ++i)
    pixel.planes[static_cast<std::size_t>(i)] =
        symmetry_of_plane(window, p, axes.eigenvectors().col(i), lambda_mm);
  return pixel;
}

double PixelSymmetry::score() const { return std::max({planes[0].score, planes[1].score, planes[2].score}); }

cv::Mat1d symmetry_map(const Level& level, const Symmetry3dParams& params) {
  cv::Mat1d map(level.depth_mm.size(), 0.0);
  for (int r = 0; r < map.rows; ++r)
    for (int c = 0; c < map.cols; ++c)
      if (const auto pixel = symmetry_at(level, r, c, params)) map(r, c) = pixel->score();
  return map;
}

namespace {

// Whether no neighbour of a pixel inside the border is higher.
bool is_peak(const cv::Mat1d& map, int row, int col) {
  for (int v = -1; v <= 1; ++v)
    for (int u = -1; u <= 1; ++u)
      if (map(row + v, col + u) > map(row, col)) return false;
  return true;
}

// Itti's N(.)
double itti_weight(const cv::Mat1d& map, double maximum) {
  double sum = 0;
  int count = 0;
  bool highest_seen = false;  // one highest peak is left out, others as high are not
  for (int r = 1; r + 1 < map.rows; ++r)
    for (int c = 1; c + 1 < map.cols; ++c) {
      const double value = map(r, c);
      if (value <= 0 || !is_peak(map, r, c)) continue;
      if (value == maximum && !highest_seen) {
        highest_seen = true;
        continue;
      }
      sum += value / maximum;
      ++count;
    }
  const double mean = count ? sum / count : 0;
  return (1 - mean) * (1 - mean) / maximum;
}

// Value of `map` at a fractional position, bilinear, clamped at the border.
double interpolate(const cv::Mat1d& map, double row, double col) {
  const int r0 = std::min(static_cast<int>(row), map.rows - 1),
            c0 = std::min(static_cast<int>(col), map.cols - 1);
  const int r1 = std::min(r0 + 1, map.rows - 1), c1 = std::min(c0 + 1, map.cols - 1);
  const double v = row - r0, u = col - c0;
  return (1 - v) * ((1 - u) * map(r0, c0) + u * map(r0, c1)) + v * ((1 - u) * map(r1, c0) + u * map(r1, c1));
}

}  // namespace

double level_weight(const cv::Mat1d& map, LevelNormalisation kind) {
  if (kind == LevelNormalisation::none) return 1;
  double maximum = 0;
  cv::minMaxLoc(map, nullptr, &maximum);
  if (maximum <= 0) return 1;
  return kind == LevelNormalisation::max ? 1 / maximum : itti_weight(map, maximum);
}

// Section 3
cv::Mat1d master_map(const std::vector<cv::Mat1d>& maps, int first_level, cv::Size full,
                     LevelNormalisation kind) {
  cv::Mat1d master(full, 0.0);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const double scale = std::ldexp(1.0, -(first_level + static_cast<int>(i))),
                 weight = level_weight(maps[i], kind);
    for (int r = 0; r < full.height; ++r)
      for (int c = 0; c < full.width; ++c)
        // Eq. (15)
        master(r, c) += weight * interpolate(maps[i], r * scale, c * scale);
  }
  return master;
}

Result symmetry3d(const cv::Mat1f& depth_mm, const Intrinsics& camera, const Symmetry3dParams& params) {
  check_levels(depth_mm.size(), params);
  Result result;
  cv::Mat1d depth;
  depth_mm.convertTo(depth, CV_64F);
  for (int l = 0; l <= params.last_level; ++l) {
    if (l > 0) depth = halve(depth);
    if (l < params.first_level) continue;
    result.levels.push_back(symmetry_map(make_level(depth, camera.at_level(l)), params));
  }
  result.master = master_map(result.levels, params.first_level, depth_mm.size(), params.normalisation);
  return result;
}

}  // namespace saccade::reference
