#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

namespace saccade {

/// The camera poses of `folder`/poses.txt: a row of 16 numbers for each frame, a 4 x 4 matrix row by row,
/// camera to world in metres. Gives them in mm; std::nullopt for a row of numbers that are not finite, which
/// stands for a lost camera; empty if there is no such file. Throws Error (unreadable) for other rows.
[[nodiscard]] std::vector<std::optional<cv::Affine3d>> read_poses(const std::filesystem::path& folder);

/// The poses of a trajectory.log of Open3D and Redwood: for each frame three integers, of which the first is
/// its position, and a 4 x 4 matrix as above. Gives them in mm, by position. Throws Error (unreadable).
[[nodiscard]] std::map<std::int64_t, cv::Affine3d> read_trajectory(const std::filesystem::path& file);

/// Camera poses in a file for each frame: a 4 x 4 matrix, camera to world in metres.
class FramePoses {
 public:
  /// The pose (mm) of a file; std::nullopt if the name is empty, if the numbers are not finite, which stands
  /// for a lost camera, or if the file cannot be read, which is a note.
  std::optional<cv::Affine3d> read(const std::filesystem::path& file);

  bool any() const { return files_ > 0; }  ///< a file was named
  void add_note(std::vector<std::string>& notes) const;

 private:
  std::int64_t files_ = 0, broken_ = 0;
  std::string first_problem_;
};

/// A camera's way through the world, by times.
class TimedPoses {
 public:
  /// Reads a groundtruth.txt of TUM RGB-D: lines "time tx ty tz qx qy qz qw", seconds and metres, camera to
  /// world; '#' starts a comment. Throws Error (unreadable).
  explicit TimedPoses(const std::filesystem::path& file);

  /// The pose (mm) at a time, interpolated between two that are at most 0.1 s apart; std::nullopt where there
  /// is none.
  std::optional<cv::Affine3d> at(double time_s) const;

 private:
  struct TimedPose {
    double time_s = 0;
    cv::Vec3d place_mm;
    cv::Vec4d turn;  // unit quaternion: w, x, y, z
  };
  std::vector<TimedPose> poses_;  // in the order of their times
};

}  // namespace saccade
