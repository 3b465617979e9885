#pragma once

#include <filesystem>

#include "sources/folder_listing.hpp"

namespace saccade {

/// True for a folder in the layout of the Object Segmentation Database (OSD, TOSD): image_color/ or
/// annotation/ beside depth/, disparity/ or point_cloud/.
bool is_osd(const std::filesystem::path& folder);

/// The frames of such a folder, in the natural order of their names (learn2 before learn10): a frame for each
/// depth image of depth/ or disparity/ (16-bit PNG in mm) or organised cloud of point_cloud/ (.pcd), taken in
/// this order of preference for each name, with the files of the same name in image_color/ and annotation/.
/// Throws Error (unreadable) if there are none.
FolderListing list_osd(const std::filesystem::path& folder);

}  // namespace saccade
