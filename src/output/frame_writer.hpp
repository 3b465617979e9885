#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "output/overlay.hpp"
#include "pipeline/result.hpp"

namespace saccade {

/// Writes what --dump asks for of one frame into `folder`, each file whole or not at all (SPEC section 7):
/// maps: NNNNNN_saliency.tiff (32-bit float) and .png (8-bit, the root of the share of the largest value);
/// overlay: NNNNNN_overlay.png; levels: NNNNNN_levelL.tiff at each level's own size; normals:
/// NNNNNN_normals.tiff (x, y, z as 3 x 32-bit float, camera frame, 0 = none); masks: NNNNNN_masks.png
/// (16-bit, rank of the fixation whose proto-object it is, 0 = none); labels: NNNNNN_labels.png (16-bit, the
/// source's own instances, 0 = none) if it knows them. `style` is that of the overlay. Throws Error (failed).
/// Thread-safe for different frames.
void write_frame(const std::filesystem::path& folder, const Result& result, const std::set<std::string>& dump,
                 int first_level, const OverlayStyle& style = {});

}  // namespace saccade
