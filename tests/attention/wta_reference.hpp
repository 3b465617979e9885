#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

struct ReferenceWinner {
  int row = 0, col = 0, step = 0;
};

/// The Winner-Take-All network as its equations say it: every neuron of one kind, every step in full, no
/// bound, no shortcut. Runs `steps` steps and lists every cell that wins, also again.
std::vector<ReferenceWinner> reference_winners(const cv::Mat1f& map, double foa_px, int steps);

}  // namespace saccade
