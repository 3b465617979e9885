#include "attention/surface_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core/hal/intrin.hpp>

#include "attention/cell_pixels.hpp"

namespace saccade {
namespace {

constexpr int kCell = SurfaceGrid::kCellPx;
constexpr int kReach = 2;  // cells; of the normals' window and of the baseline of the concavity test

// Concave: the normals kReach cells to both sides turn towards each other by more than this along the line
// between them (the sine of some 17 degrees; more with the noise of far surfaces).
constexpr float kConcave = 0.3F, kConcavePerMetre = 0.1F;
constexpr float kConcaveReach = 0.05F;  // of the depth; farther apart in depth is a jump and no edge

// By value: compilers make no vectors of std::min and std::max, which give references.
constexpr float lower(float a, float b) { return a < b ? a : b; }
constexpr float higher(float a, float b) { return a > b ? a : b; }

}  // namespace

void SurfaceGrid::build(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
  rows_ = (depth_mm.rows + kCell - 1) / kCell;
  cols_ = (depth_mm.cols + kCell - 1) / kCell;
  constexpr double kMiddle = (kCell - 1) / 2.0;
  camera_ = camera;
  camera_.fx /= kCell;
  camera_.fy /= kCell;
  camera_.cx = (camera.cx - kMiddle) / kCell;
  camera_.cy = (camera.cy - kMiddle) / kCell;
  make_cells(depth_mm);
  make_normals();
  find_concave_edges();
  find_links();
}

// Of a cell that a jump crosses, or that has gaps or is cut by the border.
float SurfaceGrid::cell_depth(const cv::Mat1f& depth, int row, int col) const {
  using Lanes = cv::v_float32x4;
  static_assert(kCell == Lanes::nlanes);
  const CellPixels pixels(depth, row, col);
  float z0 = 0;
  for (const int v : {1, 2, 0, 3})  // from the middle
    for (const int u : {1, 2, 0, 3})
      if (z0 == 0) z0 = pixels.row(v)[u];
  if (!(z0 > 0)) return 0;
  const Lanes first = cv::v_setall_f32(z0), reach = cv::v_setall_f32(kSameSurface * z0),
              one = cv::v_setall_f32(1);
  Lanes sum = cv::v_setzero_f32(), count = sum;
  for (int v = 0; v < kCell; ++v) {
    const Lanes z = cv::v_load(pixels.row(v)), same = cv::v_abs(z - first) <= reach;  // 0 is out of reach
    sum += z & same;
    count += one & same;
  }
  return cv::v_reduce_sum(sum) / cv::v_reduce_sum(count);
}

void SurfaceGrid::make_cells(const cv::Mat1f& depth) {
  const std::size_t cells = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_);
  for (auto* array : {&x_, &y_, &z_, &w_}) array->resize(cells);
  const auto width = static_cast<std::size_t>(depth.cols);
  for (auto* array : {&column_low_, &column_high_, &column_sum_}) array->resize(width);
  float* const low = column_low_.data();
  float* const high = column_high_.data();
  float* const sum = column_sum_.data();
  std::size_t i = 0;
  for (int r = 0; r < rows_; ++r) {
    const bool whole_rows = (r + 1) * kCell <= depth.rows;
    if (whole_rows) {
      const float *a = depth[r * kCell], *b = depth[r * kCell + 1], *c = depth[r * kCell + 2],
                  *d = depth[r * kCell + 3];
      for (std::size_t u = 0; u < width; ++u) {
        low[u] = lower(lower(a[u], b[u]), lower(c[u], d[u]));
        high[u] = higher(higher(a[u], b[u]), higher(c[u], d[u]));
        sum[u] = (a[u] + b[u]) + (c[u] + d[u]);
      }
    }
    const float slope_y = static_cast<float>((r - camera_.cy) / camera_.fy);
    const float scale_x = static_cast<float>(1 / camera_.fx), middle_x = static_cast<float>(camera_.cx);
    for (int c = 0; c < cols_; ++c, ++i) {
      const std::size_t u = static_cast<std::size_t>(c) * kCell;
      float z = 0;
      if (whole_rows && u + kCell <= width) {
        const float lowest = lower(lower(low[u], low[u + 1]), lower(low[u + 2], low[u + 3]));
        const float highest = higher(higher(high[u], high[u + 1]), higher(high[u + 2], high[u + 3]));
        if (lowest > 0 && highest - lowest <= kSameSurface * lowest)
          z = ((sum[u] + sum[u + 1]) + (sum[u + 2] + sum[u + 3])) / (kCell * kCell);
        else if (highest > 0)
          z = cell_depth(depth, r, c);
      } else {
        z = cell_depth(depth, r, c);
      }
      z_[i] = z;
      w_[i] = z > 0 ? 1 / z : 0;
      x_[i] = (static_cast<float>(c) - middle_x) * scale_x * z;
      y_[i] = slope_y * z;
    }
  }
}

void SurfaceGrid::set_normal(std::size_t i, int row, int col, float slope_u, float slope_v, float w) {
  const float a = slope_u * static_cast<float>(camera_.fx), b = slope_v * static_cast<float>(camera_.fy);
  const float c = w - slope_u * (static_cast<float>(col) - static_cast<float>(camera_.cx)) -
                  slope_v * (static_cast<float>(row) - static_cast<float>(camera_.cy));
  const float scale = -1 / std::sqrt(a * a + b * b + c * c);
  nx_[i] = a * scale;
  ny_[i] = b * scale;
  nz_[i] = c * scale;
}

// The plane fit with some of the cells missing or on another surface, for kLanes cells of a row at once. The
// sums over u come first, then those over v; u and v are integers, so only the sums of w are rounded.
void SurfaceGrid::normals_with_gaps(int row, int first_col) {
  using Lanes = cv::v_float32x4;
  const std::size_t stride = padded_stride(),
                    corner = static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(first_col),
                    middle = corner + kReach * stride + kReach;
  const Lanes z0 = cv::v_load(&padded_z_[middle]), w0 = cv::v_load(&padded_w_[middle]);
  const Lanes reach = z0 * cv::v_setall_f32(kSameSurface), one = cv::v_setall_f32(1),
              zero = cv::v_setzero_f32();
  Lanes n = zero, su = zero, sv = zero, suu = zero, svv = zero, suv = zero, sw = zero, suw = zero, svw = zero;
  for (int v = 0; v <= 2 * kReach; ++v) {
    std::array<Lanes, 2 * kReach + 1> use, w;
    for (std::size_t u = 0; u < use.size(); ++u) {
      const std::size_t j = corner + static_cast<std::size_t>(v) * stride + u;
      const Lanes same = cv::v_abs(cv::v_load(&padded_z_[j]) - z0) <= reach;
      use[u] = one & same;
      w[u] = (cv::v_load(&padded_w_[j]) - w0) & same;
    }
    const Lanes y = cv::v_setall_f32(static_cast<float>(v - kReach));
    const Lanes row_n = (use[0] + use[4]) + (use[1] + use[3]) + use[2];
    const Lanes end_u = use[4] - use[0], row_u = (end_u + end_u) + (use[3] - use[1]);
    const Lanes end_uu = (use[4] + use[0]) + (use[4] + use[0]);
    const Lanes row_w = (w[0] + w[4]) + (w[1] + w[3]) + w[2], end_w = w[4] - w[0];
    n += row_n, su += row_u, suu += (end_uu + end_uu) + (use[1] + use[3]);
    sv += y * row_n, svv += y * y * row_n, suv += y * row_u;
    sw += row_w, suw += (end_w + end_w) + (w[3] - w[1]), svw += y * row_w;
  }
  const Lanes uu = n * suu - su * su, vv = n * svv - sv * sv, uv = n * suv - su * sv;
  const Lanes uw = n * suw - su * sw, vw = n * svw - sv * sw, determinant = uu * vv - uv * uv;
  const Lanes fits = (n >= cv::v_setall_f32(6)) & (determinant > zero) & (z0 > zero);
  const Lanes divisor = cv::v_select(fits, determinant, one);
  const Lanes slope_u = (uw * vv - vw * uv) / divisor, slope_v = (vw * uu - uw * uv) / divisor;
  const Lanes at_middle = w0 + (sw - slope_u * su - slope_v * sv) / cv::v_max(n, one);
  alignas(16) float a[kLanes], b[kLanes], c[kLanes], fit[kLanes];
  cv::v_store(a, slope_u), cv::v_store(b, slope_v), cv::v_store(c, at_middle), cv::v_store(fit, fits & one);
  for (int k = 0; k < kLanes && first_col + k < cols_; ++k)
    if (fit[k] != 0)
      set_normal(static_cast<std::size_t>(row * cols_ + first_col + k), row, first_col + k, a[k], b[k], c[k]);
}

void SurfaceGrid::pad() {
  const std::size_t stride = padded_stride(), width = static_cast<std::size_t>(cols_);
  padded_z_.assign((static_cast<std::size_t>(rows_) + 2 * kReach) * stride, 0.0F);
  padded_w_.assign(padded_z_.size(), 0.0F);
  for (std::size_t r = 0; r < static_cast<std::size_t>(rows_); ++r) {
    std::copy_n(&z_[r * width], width, &padded_z_[(r + kReach) * stride + kReach]);
    std::copy_n(&w_[r * width], width, &padded_w_[(r + kReach) * stride + kReach]);
  }
}

// True if the 5 x 5 cells around a cell are all of its surface.
bool SurfaceGrid::is_whole(int row, int col) const {
  if (row < kReach || col < kReach || row + kReach >= rows_ || col + kReach >= cols_) return false;
  const auto width = static_cast<std::size_t>(cols_);
  const std::size_t i = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(col);
  const std::size_t a = i - 2 * width, b = i - width, d = i + width, e = i + 2 * width;
  const float low = lower(lower(lower(lowest_[a], lowest_[b]), lower(lowest_[d], lowest_[e])), lowest_[i]);
  const float high =
      higher(higher(higher(highest_[a], highest_[b]), higher(highest_[d], highest_[e])), highest_[i]);
  return high - z_[i] <= kSameSurface * z_[i] && z_[i] - low <= kSameSurface * z_[i];
}

void SurfaceGrid::sum_fives() {
  for (auto* array : {&lowest_, &highest_, &sum_, &sum_u_}) array->resize(size());
  const float *z = z_.data(), *w = w_.data();
  float *low = lowest_.data(), *high = highest_.data(), *sum = sum_.data(), *sum_u = sum_u_.data();
  const int last = static_cast<int>(size()) - kReach;
  for (int i = kReach; i < last; ++i) {  // also across the ends of rows; those are not used
    low[i] = lower(lower(lower(z[i - 2], z[i - 1]), lower(z[i + 1], z[i + 2])), z[i]);
    high[i] = higher(higher(higher(z[i - 2], z[i - 1]), higher(z[i + 1], z[i + 2])), z[i]);
    sum[i] = ((w[i - 2] + w[i + 2]) + (w[i - 1] + w[i + 1])) + w[i];
    sum_u[i] = 2 * (w[i + 2] - w[i - 2]) + (w[i + 1] - w[i - 1]);
  }
}

// Where all 25 cells are of one surface the sums are separable, five in a row first, then five rows: 25
// cells, sum of u^2 = sum of v^2 = 50, all mixed sums 0.
void SurfaceGrid::make_normals() {
  for (auto* array : {&nx_, &ny_, &nz_}) array->assign(size(), 0.0F);
  sum_fives();
  pad();
  const auto width = static_cast<std::size_t>(cols_);
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < cols_; ++c) {
      const std::size_t i = static_cast<std::size_t>(r) * width + static_cast<std::size_t>(c);
      if (z_[i] == 0) continue;
      if (!is_whole(r, c)) {
        normals_with_gaps(r, c);
        c += kLanes - 1;
        continue;
      }
      const std::size_t a = i - 2 * width, b = i - width, d = i + width, e = i + 2 * width;
      const float slope_u = ((sum_u_[a] + sum_u_[e]) + (sum_u_[b] + sum_u_[d]) + sum_u_[i]) / 50;
      const float slope_v = (2 * (sum_[e] - sum_[a]) + (sum_[d] - sum_[b])) / 50;
      set_normal(i, r, c, slope_u, slope_v, ((sum_[a] + sum_[e]) + (sum_[b] + sum_[d]) + sum_[i]) / 25);
    }
}

// A cell lies on a concave edge if, along one of four directions, the surface turns towards the camera
// around it. Both ends are kReach cells off, where the normals do not mix the two sides; that makes the edge
// some cells wide, so that no gap of the noise lets a segment leak through.
void SurfaceGrid::find_concave_edges() {
  marked_.assign(size(), 0);
  const int directions[4][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}};
  for (const auto& [down, right] : directions) {
    const int first_col = right == 0 ? 0 : kReach, last_col = right == 0 ? cols_ : cols_ - kReach;
    for (int r = down * kReach; r < rows_ - down * kReach; ++r)
      mark_concave(r * cols_ + first_col, r * cols_ + last_col, kReach * (down * cols_ + right));
  }
  convex_.resize(size());
  for (std::size_t i = 0; i < size(); ++i)
    convex_[i] = static_cast<std::uint8_t>((nz_[i] != 0) & (marked_[i] == 0));
}

// Cells [begin, end) with the ends of the baseline `step` before and behind. Selections instead of branches,
// so that compilers make vectors of it.
void SurfaceGrid::mark_concave(int begin, int end, int step) {
  const float *x = x_.data(), *y = y_.data(), *z = z_.data();
  const float *nx = nx_.data(), *ny = ny_.data(), *nz = nz_.data();
  std::int32_t* const concave = marked_.data();
  for (int i = begin; i < end; ++i) {
    const int a = i - step, b = i + step;
    const float px = x[b] - x[a], py = y[b] - y[a], pz = z[b] - z[a];
    const float turn = (nx[b] - nx[a]) * px + (ny[b] - ny[a]) * py + (nz[b] - nz[a]) * pz;
    const float farther = kPerMetre * z[i] - 1;
    const float limit = kConcave + kConcavePerMetre * (farther > 0 ? farther : 0);
    const float towards = turn < 0 ? turn * turn : 0;
    const float away_a = std::abs(z[a] - z[i]), away_b = std::abs(z[b] - z[i]);
    const float away = away_a > away_b ? away_a : away_b;
    const float without_jump = away <= kConcaveReach * z[i] ? towards : 0;
    const float with_normals = nz[a] * nz[b] > 0 ? without_jump : 0;
    concave[i] = with_normals > limit * limit * (px * px + py * py + pz * pz) ? 1 : concave[i];
  }
}

void SurfaceGrid::find_links() {
  links_.assign(size(), 0);
  mark_linked(1);
  for (int r = 1; r <= rows_; ++r) marked_[static_cast<std::size_t>(r * cols_ - 1)] = 0;  // ends of rows
  add_links(1, kRight, kLeft);
  mark_linked(cols_);
  add_links(cols_, kDown, kUp);
}

// Marks the cells that are linked with the one `step` behind, also across the ends of rows. Linked: the step
// in depth, or the distance from the tangent plane of one of the two (which a slanted surface keeps small),
// is below the jump. Without branches, so that compilers make vectors of it.
void SurfaceGrid::mark_linked(int step) {
  const float *x = x_.data(), *y = y_.data(), *z = z_.data();
  const float *nx = nx_.data(), *ny = ny_.data(), *nz = nz_.data();
  std::int32_t* const marked = marked_.data();
  const int last = static_cast<int>(size()) - step;
  for (int a = 0; a < last; ++a) {
    const int b = a + step;
    const float dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
    const float jump = jump_mm(z[a]);
    const float from_a = std::abs(nx[a] * dx + ny[a] * dy + nz[a] * dz);
    const float from_b = std::abs(nx[b] * dx + ny[b] * dy + nz[b] * dz);
    const float none = 2 * jump;
    const float nearest = lower(lower(std::abs(dz), nz[a] != 0 ? from_a : none), nz[b] != 0 ? from_b : none);
    const float valid = lower(z[a], z[b]);
    marked[a] = (valid > 0 ? nearest : none) < jump ? 1 : 0;
  }
}

void SurfaceGrid::add_links(int step, Link ahead, Link behind) {
  const std::int32_t* const marked = marked_.data();
  std::uint8_t* const links = links_.data();
  const int last = static_cast<int>(size()) - step;
  for (int i = 0; i < last; ++i) links[i] |= static_cast<std::uint8_t>(marked[i] * ahead);
  for (int i = 0; i < last; ++i) links[i + step] |= static_cast<std::uint8_t>(marked[i] * behind);
}

}  // namespace saccade
