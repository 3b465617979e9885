#include "attention/surface_grid.hpp"

#include <algorithm>

#include <opencv2/core/hal/intrin.hpp>

#include "attention/simd/cell_edges.hpp"
#include "attention/simd/cell_means.hpp"
#include "attention/simd/cell_normals.hpp"
#include "attention/simd/cell_pixels.hpp"

namespace saccade {
namespace {

static_assert(SurfaceGrid::kCellPx == kCellPx);

constexpr int kConcaveReach = 2;  // cells, to both ends of the baseline of the concavity test

// The sine of some 17 degrees; more with the noise of far surfaces.
constexpr ConcaveLimit kConcave = {.sine = 0.3F, .sine_per_metre = 0.1F, .reach = 0.05F};

}  // namespace

void SurfaceGrid::build(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
  rows_ = (depth_mm.rows + kCellPx - 1) / kCellPx;
  cols_ = (depth_mm.cols + kCellPx - 1) / kCellPx;
  constexpr double kMiddle = (kCellPx - 1) / 2.0;
  camera_ = camera;
  camera_.fx /= kCellPx;
  camera_.fy /= kCellPx;
  camera_.cx = (camera.cx - kMiddle) / kCellPx;
  camera_.cy = (camera.cy - kMiddle) / kCellPx;
  make_cells(depth_mm);
  if (size() == 0) return;
  make_normals();
  find_concave_edges();
  find_links();
}

// Of a cell that a jump crosses, or that has gaps or is cut by the border.
float SurfaceGrid::cell_depth(const cv::Mat1f& depth, int row, int col) const {
  using Lanes = cv::v_float32x4;
  static_assert(kCellPx == Lanes::nlanes);
  const CellPixels pixels(depth, row, col);
  float z0 = 0;
  for (const int v : {1, 2, 0, 3})  // from the middle
    for (const int u : {1, 2, 0, 3})
      if (z0 == 0) z0 = pixels.row(v)[u];
  if (!(z0 > 0)) return 0;
  const Lanes first = cv::v_setall_f32(z0), reach = cv::v_setall_f32(kSameSurface * z0),
              one = cv::v_setall_f32(1);
  Lanes sum = cv::v_setzero_f32(), count = sum;
  for (int v = 0; v < kCellPx; ++v) {
    const Lanes z = cv::v_load(pixels.row(v)), same = cv::v_abs(z - first) <= reach;  // 0 is out of reach
    sum += z & same;
    count += one & same;
  }
  return cv::v_reduce_sum(sum) / cv::v_reduce_sum(count);
}

void SurfaceGrid::make_cells(const cv::Mat1f& depth) {
  const std::size_t cells = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_);
  for (auto* array : {&x_, &y_, &z_, &w_}) array->resize(cells);
  for (int r = 0; r < rows_; ++r) {
    const std::size_t begin = static_cast<std::size_t>(r) * static_cast<std::size_t>(cols_);
    float* const z = &z_[begin];
    const int top = r * kCellPx, whole = top + kCellPx <= depth.rows ? depth.cols / kCellPx : 0;
    if (whole > 0)
      mean_depths({depth[top], depth[top + 1], depth[top + 2], depth[top + 3]}, kSameSurface, z,
                  static_cast<std::size_t>(whole));
    for (int c = 0; c < cols_; ++c)
      if (c >= whole || z[c] == kMixedDepth) z[c] = cell_depth(depth, r, c);
    place_row(r, z, &x_[begin], &y_[begin], &w_[begin]);
  }
}

// The points of a row of cells, and their inverse depths. Selections instead of branches, so that compilers
// make vectors of it.
void SurfaceGrid::place_row(int row, const float* z, float* x, float* y, float* w) const {
  const float slope_y = static_cast<float>((row - camera_.cy) / camera_.fy);
  const float scale_x = static_cast<float>(1 / camera_.fx), middle_x = static_cast<float>(camera_.cx);
  for (int c = 0; c < cols_; ++c) {
    w[c] = z[c] > 0 ? 1 / z[c] : 0;
    x[c] = (static_cast<float>(c) - middle_x) * scale_x * z[c];
    y[c] = slope_y * z[c];
  }
}

void SurfaceGrid::make_normals() {
  for (auto* array : {&nx_, &ny_, &nz_}) array->resize(size());
  const FramedCells cells = frame();
  const auto cols = static_cast<std::size_t>(cols_);
  for (std::size_t r = 0; r < static_cast<std::size_t>(rows_); ++r)
    find_normals(cells, camera_, kSameSurface, r, cols, {&nx_[r * cols], &ny_[r * cols], &nz_[r * cols]});
}

FramedCells SurfaceGrid::frame() {
  const auto cols = static_cast<std::size_t>(cols_), rows = static_cast<std::size_t>(rows_);
  const std::size_t stride = cols + 2 * kNormalReach;
  for (auto* array : {&framed_z_, &framed_w_}) array->assign((rows + 2 * kNormalReach) * stride, 0.0F);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t to = (r + kNormalReach) * stride + kNormalReach;
    std::copy_n(&z_[r * cols], cols, &framed_z_[to]);
    std::copy_n(&w_[r * cols], cols, &framed_w_[to]);
  }
  return {framed_z_.data(), framed_w_.data(), stride};
}

OrientedCells SurfaceGrid::oriented() const {
  return {x_.data(), y_.data(), z_.data(), nx_.data(), ny_.data(), nz_.data()};
}

// A cell lies on a concave edge if, along one of four directions, the surface turns towards the camera
// around it. Both ends are kConcaveReach cells off, where the normals do not mix the two sides; that makes
// the edge some cells wide, so that no gap of the noise lets a segment leak through.
void SurfaceGrid::find_concave_edges() {
  concave_.assign(size(), 0);
  constexpr int kDirections[4][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}};
  for (int r = 0; r < rows_; ++r)
    for (const auto& [down, right] : kDirections) {
      const int first = right == 0 ? 0 : kConcaveReach, last = cols_ - first;
      if (last <= first || r < down * kConcaveReach || r + down * kConcaveReach >= rows_) continue;
      mark_concave(
          oriented(), static_cast<std::size_t>(r * cols_ + first), static_cast<std::size_t>(r * cols_ + last),
          static_cast<std::size_t>(kConcaveReach * (down * cols_ + right)), kConcave, concave_.data());
    }
  convex_.resize(size());
  for (std::size_t i = 0; i < size(); ++i)
    convex_[i] = static_cast<std::uint8_t>((nz_[i] != 0) & (concave_[i] == 0));
}

void SurfaceGrid::find_links() {
  const auto cols = static_cast<std::size_t>(cols_);
  for (auto* array : {&right_, &down_}) array->assign(size(), 0);
  find_linked(oriented(), size() - 1, 1, kJump, right_.data());
  for (std::size_t end = cols; end <= size(); end += cols) right_[end - 1] = 0;  // not across ends of rows
  find_linked(oriented(), size() - cols, cols, kJump, down_.data());
  links_.resize(size());
  const auto bit = [](std::uint8_t linked, Link link) { return static_cast<std::uint8_t>(linked * link); };
  for (std::size_t i = 0; i < size(); ++i) links_[i] = bit(right_[i], kRight) | bit(down_[i], kDown);
  for (std::size_t i = 1; i < size(); ++i) links_[i] |= bit(right_[i - 1], kLeft);
  for (std::size_t i = cols; i < size(); ++i) links_[i] |= bit(down_[i - cols], kUp);
}

}  // namespace saccade
