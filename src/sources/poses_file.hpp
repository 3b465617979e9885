#pragma once

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

namespace saccade {

/// The camera poses of `folder`/poses.txt: a row of 16 numbers for each frame, a 4 x 4 matrix row by row,
/// camera to world in metres. Gives them in mm; empty if there is no such file. Throws Error (unreadable) for
/// other rows.
[[nodiscard]] std::vector<cv::Affine3d> read_poses(const std::filesystem::path& folder);

}  // namespace saccade
