#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// The number of a cell or a segment as an index.
inline std::size_t at(int number) { return static_cast<std::size_t>(number); }

struct FramedCells;
struct OrientedCells;

/// The depth image in cells of kCellPx x kCellPx pixels, each with a depth, a point, a normal over a wide
/// window, and the links to its neighbours: two cells are linked if one surface goes through both.
/// Arrays are row by row; they and their memory stay until the next build().
/// Thread safety: one build() at a time per object; reading is free.
class SurfaceGrid {
 public:
  static constexpr int kCellPx = 4;

  /// What a cell is linked to (bits of links()).
  enum Link : std::uint8_t { kRight = 1, kDown = 2, kLeft = 4, kUp = 8 };

  /// Builds the grid of one frame. depth_mm: H x W, 0 = no reading. The last cells of a row or column may
  /// hold fewer pixels.
  void build(const cv::Mat1f& depth_mm, const Intrinsics& camera);

  /// A step in depth that is larger than this ends a surface; mm. Grows with z, and beyond 1 m with z^2, as
  /// the noise of sensors does.
  static float jump_mm(float depth_mm) {
    return kJump * depth_mm * (kPerMetre * depth_mm > 1 ? kPerMetre * depth_mm : 1);
  }

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  std::size_t size() const { return z_.size(); }
  /// Of the cells: pixel (row, col) of it is the middle of cell (row, col).
  const Intrinsics& camera() const { return camera_; }

  /// Depth of each cell: mean over the pixels that differ by at most kSameSurface from the cell's first valid
  /// pixel, counted from its middle. 0 = no pixel has depth.
  const std::vector<float>& depth_mm() const { return z_; }
  const std::vector<float>& inverse_depth() const { return w_; }  ///< 1/mm, 0 = no depth

  /// Unit normals towards the camera, (0,0,0) = none: a plane in inverse depth over the 5 x 5
  /// cells around.
  const std::vector<float>& normal_x() const { return nx_; }
  const std::vector<float>& normal_y() const { return ny_; }
  const std::vector<float>& normal_z() const { return nz_; }

  /// Neighbours of one surface with this cell: no depth jump between them.
  const std::vector<std::uint8_t>& links() const { return links_; }

  /// 1 where a segment of convex surface can grow: there is a normal, and no concave edge passes.
  const std::vector<std::uint8_t>& convex() const { return convex_; }

  static constexpr float kSameSurface = 0.02F;  ///< of the depth; beyond it is another surface

 private:
  static constexpr float kJump = 0.012F;     // of the depth
  static constexpr float kPerMetre = 1e-3F;  // 1/mm

  void make_cells(const cv::Mat1f& depth_mm);
  float cell_depth(const cv::Mat1f& depth_mm, int row, int col) const;
  void place_row(int row, const float* z, float* x, float* y, float* w) const;
  void make_normals();
  FramedCells frame();
  OrientedCells oriented() const;
  void find_concave_edges();
  void find_links();

  int rows_ = 0, cols_ = 0;
  Intrinsics camera_;
  std::vector<float> x_, y_, z_, w_, nx_, ny_, nz_;
  std::vector<float> framed_z_, framed_w_;  ///< with a frame of cells without depth
  std::vector<std::uint8_t> concave_;       ///< cells of a concave edge
  std::vector<std::uint8_t> right_, down_;  ///< cells that are linked with the next one
  std::vector<std::uint8_t> links_, convex_;
};

}  // namespace saccade
