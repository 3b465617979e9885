#include "output/tum_writer.hpp"

#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <opencv2/core/quaternion.hpp>

#include "core/error.hpp"
#include "core/png.hpp"
#include "output/dataset_writer.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr double kTumUnit_mm = 0.2;

std::string seconds(std::int64_t time_us) {
  const auto parts = std::lldiv(std::llabs(time_us), 1'000'000);
  return fmt::format("{}{}.{:06}", time_us < 0 ? "-" : "", parts.quot, parts.rem);
}

std::string image_name(const char* folder, const Frame& frame) {
  return fmt::format("{}/{:06}.png", folder, frame.index);
}

// "tx ty tz qx qy qz qw", metres.
std::string pose_text(const cv::Affine3d& pose) {
  constexpr double kMmPerMetre = 1000;
  const cv::Quatd q = cv::Quatd::createFromRotMat(pose.rotation());
  const cv::Vec3d t = pose.translation() / kMmPerMetre;
  return fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}", t[0], t[1], t[2], q.x, q.y, q.z,
                     q.w);
}

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    throw failed("cannot make a folder: " + code.message(), folder.string(), "is its parent writable?");
}

bool is_exact(const Frame& frame, double unit_mm) {
  cv::Mat1w unused;
  const DepthLosses losses = depth_to_units(frame.depth_mm, unit_mm, unused);
  return losses.rounded_pixels == 0 && losses.out_of_range_pixels == 0;
}

}  // namespace

TumWriter::TumWriter(fs::path folder, SourceInfo info) : folder_(std::move(folder)), info_(std::move(info)) {}

void TumWriter::begin(const Frame& frame) {
  unit_mm_ = info_.depth_unit_mm > 0 ? info_.depth_unit_mm : unit_for(frame.depth_mm);
  if (is_exact(frame, kTumUnit_mm)) unit_mm_ = kTumUnit_mm;
  make_folder(folder_ / "depth");
  write_meta(folder_, info_, frame, unit_mm_);
  depth_list_.emplace(folder_ / "depth.txt");
  depth_list_->append("# timestamp filename");
}

void TumWriter::add_pose(const std::string& time, const cv::Affine3d& pose) {
  if (!poses_) {
    poses_.emplace(folder_ / "groundtruth.txt");
    poses_->append("# timestamp tx ty tz qx qy qz qw");
  }
  poses_->append(time + " " + pose_text(pose));
}

void TumWriter::add(const Frame& frame) {
  if (unit_mm_ == 0) begin(frame);
  const std::string time = seconds(frame.timestamp_us);
  depth_list_->append(time + " " + image_name("depth", frame));
  if (frame.truth.camera_to_world) add_pose(time, *frame.truth.camera_to_world);
  if (frame.colour.empty()) return;
  if (!colour_list_) {
    make_folder(folder_ / "rgb");
    colour_list_.emplace(folder_ / "rgb.txt");
    colour_list_->append("# timestamp filename");
  }
  colour_list_->append(time + " " + image_name("rgb", frame));
}

void TumWriter::write(const Frame& frame) {
  cv::Mat1w stored;
  const DepthLosses losses = depth_to_units(frame.depth_mm, unit_mm_, stored);
  {
    const std::lock_guard lock(mutex_);
    losses_ += losses;
  }
  write_file(folder_ / image_name("depth", frame), encode_png(stored));
  if (!frame.colour.empty()) write_file(folder_ / image_name("rgb", frame), encode_png(frame.colour));
}

void TumWriter::finish() {
  for (const std::optional<LineFile>* list : {&depth_list_, &colour_list_, &poses_})
    if (*list) (*list)->check_in_place();
}

DepthLosses TumWriter::losses() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

}  // namespace saccade
