#pragma once

#include <string>
#include <vector>

#include "attention/attention.hpp"
#include "attention/cell_competition.hpp"
#include "attention/frame_surfaces.hpp"
#include "attention/proto_objects.hpp"

namespace saccade {

/// Attention::ended_early of a frame in which nothing can be chosen, and of one in which nothing more can be.
constexpr const char* kNothingSalient = "nothing salient where there is depth";
constexpr const char* kNothingLeft = "nothing salient is left beside the proto-objects found";

/// Appends to Attention::ended_early how many fixations were left out because of `min_confidence`. Takes no
/// memory that the text does not need.
void add_doubtful(int fixations, double min_confidence, std::string& ended_early);

/// Selector `proto`: one fixation per proto-object.
///
/// Works on the cells of SurfaceGrid. The saliency is smoothed (smooth_cells) and weighed
/// (FrameSurfaces::weigh). Then, as often as asked:
///  - the winner is the cell with the largest value (CellCompetition);
///  - the fixation is its pixel of the highest saliency on the cell's surface;
///  - its proto-object is the segment around the cell (ProtoObjects);
///  - the proto-object and a margin around it are inhibited: their values become 0;
///  - inhibition of return lowers the values near the fixation. Large things fall into several proto-objects;
///    this sends the next points elsewhere first.
/// It ends early when no value above 0 is left. Of the fixations found, those with a confidence() below
/// `min_confidence` are left out; the others keep their order and are those that a lower limit gives. A mask
/// holds the pixels of the proto-object's cells that lie on its surface, not the margin; masks do not
/// overlap.
class ProtoSelector : public AttentionSelector {
 public:
  /// min_confidence: 0..1, 0 = give all fixations. Throws std::invalid_argument unless fixations >= 1.
  explicit ProtoSelector(int fixations, double min_confidence = 0);
  void select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
              Attention& attention) override;

 private:
  int fixations_;
  double min_confidence_;
  FrameSurfaces surfaces_;
  CellCompetition competition_;
  ProtoObjects objects_;
  std::vector<float> scratch_, smooth_, values_;
};

}  // namespace saccade
