#pragma once

#include <cstddef>
#include <vector>

#include "attention/attention.hpp"
#include "attention/border_ownership.hpp"
#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"

namespace saccade {

/// Mean of `saliency` over each cell of the grid (pixels beyond the border count as 0), smoothed along rows
/// and columns by the binomial [1 8 28 56 70 56 28 8 1]/256 (a Gaussian of 1.4 cells; 0 beyond the border).
/// `scratch` and `smooth` (row by row) are reused.
void smooth_cells(const cv::Mat1f& saliency, std::vector<float>& scratch, std::vector<float>& smooth);

/// Selector `proto`: one fixation per proto-object.
///
/// Works on the cells of SurfaceGrid. The saliency is smoothed (smooth_cells); cells without depth cannot
/// win. Cells of a supporting plane (SurfaceSegments) count kSupportingPlaneWeight of their value: coarse
/// pyramid levels spread an object's saliency over the table before it, and a plane behind the things is no
/// object while there are others. Cells of a segment that is seen behind other things, with less than
/// kFrontShare of its border its own (BorderOwnership), count kBehindWeight. Then, as often as asked:
///  - the winner is the cell with the largest value; ties: lowest row, then lowest column;
///  - the fixation is its pixel of the highest saliency on the cell's surface; ties as before;
///  - its proto-object is the segment of the cell; on a supporting plane, or where there is no
///    segment, it is the part that lies within kDiscCells;
///  - the proto-object and a margin of kMarginCells around it are inhibited: their values become 0;
///  - inhibition of return: every value is multiplied by 1 - kReturnDepth * exp(-d^2 / 2 s^2), d the distance
///    from the fixation in the image and s = kReturnReach of its width. Large things fall into several
///    proto-objects; this sends the next points elsewhere first.
/// It ends early when no value above 0 is left. Of the fixations found, those with a confidence() below
/// `min_confidence` are left out; the others keep their order and are those that a lower limit gives. A mask
/// holds the pixels of the proto-object's cells that lie on its surface, not the margin; masks do not
/// overlap.
class ProtoSelector : public AttentionSelector {
 public:
  static constexpr float kSupportingPlaneWeight = 0.02F;
  static constexpr float kFrontShare = 0.1F;
  static constexpr float kBehindWeight = 0.1F;
  static constexpr int kDiscCells = 10;   ///< radius; 40 px
  static constexpr int kMarginCells = 3;  ///< radius; 12 px
  static constexpr float kReturnDepth = 0.6F;
  static constexpr float kReturnReach = 3.0F / 32;  ///< 60 px of 640

  /// min_confidence: 0..1, 0 = give all fixations. Throws std::invalid_argument unless fixations >= 1.
  explicit ProtoSelector(int fixations, double min_confidence = 0);
  void select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
              Attention& attention) override;

 private:
  void weigh();
  float confidence_at(int cell, int first_cell) const;
  void list_cells_of_segments();
  bool find_winner(int& row, int& col) const;
  void collect_proto_object(int row, int col);
  void inhibit();
  void make_return_table();
  void discount_around(int row, int col);
  void clear_disc(int row, int col, int radius);
  void set_rays(cv::Size size, const Intrinsics& camera);
  ProtoObject paint(const cv::Mat1f& depth_mm, cv::Mat1w& masks, int rank) const;

  int fixations_;
  double min_confidence_;
  SurfaceGrid grid_;
  SurfaceSegments segments_;
  BorderOwnership borders_;
  std::vector<float> weight_;  ///< by segment
  std::vector<float> scratch_;
  std::vector<float> smooth_;         ///< the map by cell
  std::vector<float> value_;          ///< the same, weighed and inhibited
  std::vector<float> row_best_;       ///< largest value of each row
  std::vector<float> return_table_;   ///< exp(-d^2 / 2 s^2) by d in cells
  std::vector<float> ray_x_, ray_y_;  ///< x/z of each column, y/z of each row
  std::vector<int> first_of_segment_, cells_of_segment_;
  std::vector<int> object_;               ///< cells of the present proto-object
  std::vector<unsigned char> in_object_;  ///< the same, by cell
};

}  // namespace saccade
