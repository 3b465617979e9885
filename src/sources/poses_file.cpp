#include "sources/poses_file.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file.hpp"

namespace saccade {

std::vector<cv::Affine3d> read_poses(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "poses.txt";
  std::vector<cv::Affine3d> poses;
  if (!std::filesystem::exists(path)) return poses;
  constexpr std::uintmax_t kLargest = 256u << 20;
  constexpr double kMmPerMetre = 1000;
  const auto bytes = read_file(path, kLargest);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  for (std::string line; std::getline(text, line);) {
    std::istringstream row(line);
    if (row >> std::ws; row.eof()) continue;
    cv::Matx44d matrix;
    for (double& number : matrix.val)
      if (!(row >> number) || !std::isfinite(number))
        throw unreadable(fmt::format("pose {} is not 16 numbers", poses.size()), path.string(),
                         "fix or delete it; 4 x 4 row by row, camera to world, metres are expected");
    cv::Affine3d& pose = poses.emplace_back(matrix);
    pose.translation(pose.translation() * kMmPerMetre);
  }
  return poses;
}

}  // namespace saccade
