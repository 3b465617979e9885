#pragma once

#include <filesystem>
#include <memory>

#include "core/frame_source.hpp"

namespace saccade {

/// Opens a folder of images (SPEC section 7):
/// - `NNNN_depth.png` (16-bit gray, mm) with optional `NNNN_rgb.png|jpg`, `NNNN_label.png`,
///   `NNNN_class.png` (8 or 16 bits, 0 = void) and `meta.json` (fx fy cx cy in pixels), in the order of
///   their numbers; 30 frames a second are assumed for their times;
/// - a TUM RGB-D folder: depth.txt and optionally rgb.txt list times and files, depth has 5000 units a metre;
///   a colour image belongs to the depth image that is nearest in time, at most 20 ms away;
/// - the Object Segmentation Database (list_osd()); the camera is that of meta.json, else the one that fits
///   the points of a cloud, else a guess. In an annotation in colour each colour but black is an object.
/// A frame that cannot be used is rejected with the reason (read()); gaps in the numbers are reported in
/// info().notes. Throws Error (unreadable): no folder, no depth images, none that can be read, a broken
/// meta.json.
std::unique_ptr<FrameSource> open_folder(const std::filesystem::path& folder);

}  // namespace saccade
