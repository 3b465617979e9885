#include "scene/kinect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "scene/random.hpp"

namespace saccade::scene {
namespace {

// Streams of random numbers within one reading.
enum Stream : std::uint64_t { kPixelStream = 1, kLatticeStream = 2 };

// A length of an image 640 px wide, scaled to this width; at least 1 px.
int scaled(double at_640, int width) {
  return std::max(1, static_cast<int>(std::lround(at_640 * width / 640)));
}

}  // namespace

KinectModel::KinectModel(const KinectProperties& properties) : properties_(properties) {
  const int last = static_cast<int>(std::ceil(properties_.steps(properties_.nearest_mm)));
  depth_of_step_.resize(static_cast<std::size_t>(last) + 1);
  for (int step = 1; step <= last; ++step) {
    const double depth = properties_.steps(step);  // the relation is its own inverse
    if (depth >= properties_.nearest_mm && depth <= properties_.farthest_mm)
      depth_of_step_[static_cast<std::size_t>(step)] = static_cast<float>(std::round(depth));
  }
}

void KinectModel::set_view(const SceneRender& view, const Intrinsics& camera) {
  const cv::Size size = view.depth_mm.size();
  cell_px_ = scaled(4, size.width);
  weight_.resize(static_cast<std::size_t>(cell_px_));
  normaliser_.resize(static_cast<std::size_t>(cell_px_));
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(cell_px_);
    weight_[i] = u;
    normaliser_[i] = 1 / std::sqrt(u * u + (1 - u) * (1 - u));  // the same variance everywhere
  }
  steps_.create(size);
  for (int r = 0; r < size.height; ++r)
    std::transform(view.depth_mm[r], view.depth_mm[r] + size.width, steps_[r],
                   [&](float z) { return z > 0 ? static_cast<float>(properties_.steps(z)) : 0; });
  cast_shadow(view.depth_mm, camera);
  steps_.setTo(0, shadow_);
  find_losses(view, camera);
}

// The projector at x = +baseline sees a point of column c and depth z in its own column c - fx*baseline/z.
// It lights the nearest surface in each of its columns and leaves those behind in shadow (README 5).
void KinectModel::cast_shadow(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
  constexpr double kNearest_mm = 100;  // nearer surfaces cast the shadow of one at this depth
  const double pull = camera.fx * properties_.baseline_mm;
  const int margin = static_cast<int>(std::ceil(pull / kNearest_mm)) + 1;
  const auto column = [&](int c, float z) {
    return margin + static_cast<int>(std::floor(c - pull / std::max<double>(z, kNearest_mm) + 0.5));
  };
  const auto tolerance = static_cast<float>(1 + properties_.jump);
  shadow_.create(depth_mm.size());
  lit_.resize(static_cast<std::size_t>(depth_mm.cols + margin) + 1);
  for (int r = 0; r < depth_mm.rows; ++r) {
    const float* z = depth_mm[r];
    std::ranges::fill(lit_, std::numeric_limits<float>::infinity());
    for (int c = 0; c < depth_mm.cols; ++c) {
      if (z[c] == 0) continue;
      int first = column(c, z[c]), last = first;
      if (c + 1 < depth_mm.cols && z[c + 1] > 0 &&
          std::max(z[c], z[c + 1]) < tolerance * std::min(z[c], z[c + 1]))
        last = std::max(last, column(c + 1, z[c + 1]) - 1);  // no gaps within a surface
      for (int i = first; i <= last; ++i) {
        float& nearest = lit_[static_cast<std::size_t>(i)];
        nearest = std::min(nearest, z[c]);
      }
    }
    for (int c = 0; c < depth_mm.cols; ++c)
      shadow_(r, c) =
          z[c] > 0 && z[c] > tolerance * lit_[static_cast<std::size_t>(column(c, z[c]))] ? 255 : 0;
  }
}

void KinectModel::find_losses(const SceneRender& view, const Intrinsics& camera) {
  const cv::Size size = view.depth_mm.size();
  const int reach = scaled(1, size.width);
  const cv::Mat kernel = cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8U);
  cv::erode(view.depth_mm, nearest_, kernel);
  cv::dilate(view.depth_mm, farthest_, kernel);
  edge_.create(size);
  loss_.create(size);
  const auto tolerance = static_cast<float>(1 + properties_.jump);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      edge_(r, c) = farthest_(r, c) > tolerance * nearest_(r, c) ? 255 : 0;
      double kept = 1 - properties_.random_loss;
      if (edge_(r, c)) kept *= 1 - properties_.edge_loss;
      const cv::Vec3f& n = view.normals(r, c);
      const double x = (c - camera.cx) / camera.fx, y = (r - camera.cy) / camera.fy;
      const double cosine = -(n[0] * x + n[1] * y + n[2]) / std::sqrt(x * x + y * y + 1);
      kept *= std::clamp(
          (cosine - properties_.blind_cosine) / (properties_.grazing_cosine - properties_.blind_cosine), 0.0,
          1.0);
      loss_(r, c) = cv::saturate_cast<ushort>(65536 * (1 - kept));
    }
}

void KinectModel::draw_lattice(std::uint64_t key, int lattice_row, std::vector<float>& values) const {
  const std::uint64_t row_key = mix(key, static_cast<std::uint64_t>(lattice_row));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = gaussian(mix(row_key + i));
}

// The correlated noise of an image row, in disparity steps, to noise_. Rows come in order, from 0.
void KinectModel::draw_smooth_noise(std::uint64_t key, int row) {
  const int band = row / cell_px_;
  const auto down = static_cast<std::size_t>(row % cell_px_);
  if (down == 0) {
    draw_lattice(key, band, upper_);
    draw_lattice(key, band + 1, lower_);
  }
  const float v = weight_[down];
  const float row_scale = static_cast<float>(properties_.smooth_noise) * normaliser_[down];
  std::size_t i = 0, across = 0;
  for (float& noise : noise_) {
    const float u = weight_[across];
    noise =
        row_scale * normaliser_[across] *
        ((1 - v) * ((1 - u) * upper_[i] + u * upper_[i + 1]) + v * ((1 - u) * lower_[i] + u * lower_[i + 1]));
    if (++across == weight_.size()) across = 0, ++i;
  }
}

// The reading of a pixel in mm, 0 = none. `bits`: its random number.
float KinectModel::sense_pixel(int row, int col, std::uint64_t bits) const {
  float exact = steps_(row, col);
  if (edge_(row, col)) {  // the matching window covers both sides of the edge, and either may win
    const int dr = static_cast<int>(bits % 3) - 1, dc = static_cast<int>(bits / 3 % 3) - 1;
    exact = steps_(std::clamp(row + dr, 0, steps_.rows - 1), std::clamp(col + dc, 0, steps_.cols - 1));
  }
  if (exact == 0 || (bits >> 48) < loss_(row, col)) return 0;
  const float step = exact + noise_[static_cast<std::size_t>(col)] +
                     static_cast<float>(properties_.white_noise) * gaussian(bits);
  const int rounded = cvRound(step);
  const bool in_range = rounded > 0 && rounded < static_cast<int>(depth_of_step_.size());
  return in_range ? depth_of_step_[static_cast<std::size_t>(rounded)] : 0;
}

void KinectModel::sense(std::uint64_t key, cv::Mat1f& depth_mm) {
  if (steps_.empty()) throw std::logic_error("KinectModel: sense() before set_view()");
  const int rows = steps_.rows, cols = steps_.cols;
  depth_mm.create(rows, cols);
  const std::uint64_t pixel_key = mix(key, kPixelStream), lattice_key = mix(key, kLatticeStream);
  upper_.resize(static_cast<std::size_t>(cols / cell_px_) + 2);
  lower_.resize(upper_.size());
  noise_.resize(static_cast<std::size_t>(cols));
  for (int r = 0; r < rows; ++r) {
    draw_smooth_noise(lattice_key, r);
    const std::uint64_t row_key = mix(pixel_key, static_cast<std::uint64_t>(r));
    for (int c = 0; c < cols; ++c)
      depth_mm(r, c) = sense_pixel(r, c, mix(row_key + static_cast<std::uint64_t>(c)));
  }
}

}  // namespace saccade::scene
