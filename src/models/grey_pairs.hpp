#pragma once

#include <vector>

#include "models/mirror_pairs.hpp"

namespace saccade {

/// The moments of symmetry2d's pairs at one pixel row: rows of cos, sin and log(1 + length) of the gradient
/// that hold pixel i of a pair, and pixel j. Element c belongs to the pair about column c.
struct GreyPairRows {
  const float *cos_i, *sin_i, *strength_i;
  const float *cos_j, *sin_j, *strength_j;
};

/// Adds the contribution of each pair (models/symmetry2d.hpp) to score[0..width), in the order of `pairs`;
/// rows[k] are those of pairs[k]. The same bits with every instruction set.
void add_grey_pairs(const std::vector<MirrorPair>& pairs, const std::vector<GreyPairRows>& rows, float* score,
                    int width);

}  // namespace saccade
