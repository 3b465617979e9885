#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "output/dataset_writer.hpp"
#include "output/overlay.hpp"
#include "pipeline/result.hpp"

namespace saccade {

/// Writes the files of one frame that `dump` names into `folder`, each completely or not at all:
///
///   maps     NNNNNN_saliency.tiff (32-bit float) and .png (8-bit, see to_grey())
///   overlay  NNNNNN_overlay.png
///   levels   NNNNNN_levelL.tiff, the map of level L at its own size, 32-bit float
///   normals  NNNNNN_normals.tiff, x, y, z as 3 x 32-bit float in camera frame, 0 = none
///   masks    NNNNNN_masks.png, 16-bit, the rank of the fixation whose proto-object holds the pixel, 0 = none
///   depth    NNNNNN_depth.png, by `dataset`
///   colour   NNNNNN_rgb.png, by `dataset`; only if the frame has colour
///   cloud    NNNNNN_cloud.ply (encode_ply()), with normals if the result has them
///   labels   NNNNNN_labels.png, 16-bit, the instances of the source, 0 = none; only if the source knows them
///
/// The frame was added to `dataset`, which writes to the same folder, if its depth or colour is requested.
/// `style` is that of the overlay. Throws Error (failed). Thread-safe for different frames.
void write_frame(const std::filesystem::path& folder, const Result& result, const std::set<std::string>& dump,
                 int first_level, DatasetWriter& dataset, const OverlayStyle& style = {});

/// Removes the maps and pictures that write_frame() wrote into `folder` in an earlier run. Others stay, also
/// depth, colour and clouds. Throws Error (failed).
void remove_frame_files(const std::filesystem::path& folder);

}  // namespace saccade
