#pragma once

#include <memory>

#include "models/mirror_pairs.hpp"

namespace saccade {

/// `symmetry2d`: the isotropic symmetry of Reisfeld and Kootstra on the grey image. A pair of pixels i, j
/// that are mirrored about the centre contributes
///   (1 - cos(ti + tj - 2 alpha)) (1 - cos(ti - tj)) log(1 + mi) log(1 + mj) weight
/// with t, m the angle and length of the gradient. Needs a colour image, which may be grey.
std::unique_ptr<MirrorPairModel> make_symmetry2d(WorkerPool& pool, int last_level = 5);

/// `colour_symmetry2d`: Heidemann's symmetry of colour gradients. Every two channels k, l contribute
///   cos^2(gi + gj) cos^2(gi) cos^2(gj) log(1 + mi) log(1 + mj) weight,   g = t - alpha,
/// with i in channel k and j in channel l. Window, levels and weights are those of symmetry2d.
std::unique_ptr<MirrorPairModel> make_colour_symmetry2d(WorkerPool& pool);

}  // namespace saccade
