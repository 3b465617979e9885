#include "sources/poses_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/core/quaternion.hpp>

#include "core/depth_units.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/frame.hpp"
#include "core/text.hpp"
#include "sources/folder_files.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kBlank = " \t\r";

// Calls use(number, line) for each line of a text file that is neither blank nor a comment.
void for_each_line(const fs::path& file, const std::function<void(int, std::string_view)>& use) {
  const auto bytes = read_file(file, 256u << 20);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t first = line.find_first_not_of(kBlank);
    if (first != std::string_view::npos && line[first] != '#') use(number, line);
  }
}

// Exactly N numbers; NaN and infinities are numbers too.
template <std::size_t N>
std::optional<std::array<double, N>> numbers_of(std::string_view line) {
  std::array<double, N> numbers{};
  for (double& number : numbers) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    if (line.starts_with('+')) line.remove_prefix(1);
    const auto [end, code] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (code != std::errc{}) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
  return line.find_first_not_of(kBlank) == std::string_view::npos ? std::optional(numbers) : std::nullopt;
}

// Of a matrix in metres; std::nullopt if it is not finite.
std::optional<cv::Affine3d> pose_of(const double* matrix) {
  if (!std::all_of(matrix, matrix + 16, [](double value) { return std::isfinite(value); }))
    return std::nullopt;
  cv::Affine3d pose{cv::Matx44d(matrix)};
  pose.translation(pose.translation() * kMmPerMetre);
  return pose;
}

}  // namespace

std::vector<std::optional<cv::Affine3d>> read_poses(const fs::path& folder) {
  const fs::path path = folder / "poses.txt";
  std::vector<std::optional<cv::Affine3d>> poses;
  if (!fs::exists(path)) return poses;
  for_each_line(path, [&](int, std::string_view line) {
    const auto matrix = numbers_of<16>(line);
    if (!matrix)
      throw unreadable(fmt::format("pose {} is not 16 numbers", poses.size()), path.string(),
                       "fix or delete it; 4 x 4 row by row, camera to world, metres are expected");
    poses.push_back(pose_of(matrix->data()));
  });
  return poses;
}

std::map<std::int64_t, cv::Affine3d> read_trajectory(const fs::path& file) {
  constexpr std::size_t kOfFrame = 3 + 16;
  constexpr std::uintmax_t kLargest = 256u << 20;
  const std::vector<double> numbers = read_numbers(file, kLargest);
  if (numbers.size() % kOfFrame != 0)
    throw unreadable("not three integers and a 4 x 4 matrix for each frame", file.string(),
                     "fix or delete it");
  std::map<std::int64_t, cv::Affine3d> poses;
  for (std::size_t i = 0; i < numbers.size(); i += kOfFrame) {
    const auto pose = pose_of(&numbers[i + 3]);
    if (pose && numbers[i] >= 0 && numbers[i] <= kLastFrameIndex)
      poses.emplace(static_cast<std::int64_t>(numbers[i]), *pose);
  }
  return poses;
}

std::optional<cv::Affine3d> FramePoses::read(const fs::path& file) {
  if (file.empty()) return std::nullopt;
  ++files_;
  try {
    const std::vector<double> numbers = read_numbers(file);
    if (numbers.size() == 16) return pose_of(numbers.data());
    throw unreadable("not a 4 x 4 matrix", file.string(), "fix or delete it");
  } catch (const Error& error) {
    if (broken_++ == 0) first_problem_ = error.what();
    return std::nullopt;
  }
}

void FramePoses::add_note(std::vector<std::string>& notes) const {
  if (broken_ > 0)
    notes.push_back(fmt::format("{} of {} cannot be used; the first: {}", broken_, counted(files_, "pose"),
                                first_problem_));
}

TimedPoses::TimedPoses(const fs::path& file) {
  for_each_line(file, [&](int number, std::string_view line) {
    const auto values = numbers_of<8>(line);
    const auto finite = [](double value) { return std::isfinite(value); };
    if (!values || !std::isfinite((*values)[0]))
      throw unreadable("not a 'time tx ty tz qx qy qz qw' line", fmt::format("{}:{}", file.string(), number),
                       "fix the line, or delete the file");
    const auto& [time_s, x, y, z, qx, qy, qz, qw] = *values;
    const double length = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
    if (!std::ranges::all_of(*values, finite) || !(length > 0)) return;  // a lost camera
    poses_.push_back({time_s, kMmPerMetre * cv::Vec3d(x, y, z), cv::Vec4d(qw, qx, qy, qz) / length});
  });
  std::ranges::stable_sort(poses_, {}, &TimedPose::time_s);
}

std::optional<cv::Affine3d> TimedPoses::at(double time_s) const {
  constexpr double kLongest_s = 0.1 + 1e-6;  // times are in decimals
  const auto after = std::ranges::lower_bound(poses_, time_s, {}, &TimedPose::time_s);
  if (after == poses_.end()) return std::nullopt;
  const auto affine = [](const cv::Quatd& turn, const cv::Vec3d& place_mm) {
    return cv::Affine3d(turn.toRotMat3x3(cv::QUAT_ASSUME_UNIT), place_mm);
  };
  if (after->time_s == time_s) return affine(cv::Quatd(after->turn), after->place_mm);
  if (after == poses_.begin()) return std::nullopt;
  const TimedPose &a = *std::prev(after), &b = *after;
  if (b.time_s - a.time_s > kLongest_s) return std::nullopt;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const cv::Quatd turn = cv::Quatd::slerp(cv::Quatd(a.turn), cv::Quatd(b.turn), share, cv::QUAT_ASSUME_UNIT,
                                          /*directChange=*/true);
  return affine(turn.normalize(), a.place_mm + share * (b.place_mm - a.place_mm));
}

}  // namespace saccade
