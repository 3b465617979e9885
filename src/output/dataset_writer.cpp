#include "output/dataset_writer.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/png.hpp"
#include "output/json_text.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// Camera to world, 4 x 4 row by row, metres; NaN for a camera that is lost.
std::string pose_line(const std::optional<cv::Affine3d>& pose) {
  constexpr double kMmPerMetre = 1000;
  std::string line;
  for (int row = 0; row < 4; ++row)
    for (int col = 0; col < 4; ++col) {
      const double value = pose ? pose->matrix(row, col) : std::numeric_limits<double>::quiet_NaN();
      line += fmt::format("{}{:.17g}", line.empty() ? "" : " ",
                          row < 3 && col == 3 ? value / kMmPerMetre : value);
    }
  return line;
}

}  // namespace

std::string frame_file(std::int64_t index, std::string_view ending) {
  return fmt::format("{:06}_{}", index, ending);
}

void write_meta(const fs::path& folder, const SourceInfo& info, const Frame& first, double depth_unit_mm) {
  nlohmann::ordered_json meta = nlohmann::ordered_json::object();
  if (const Intrinsics& camera = first.intrinsics; camera.origin != IntrinsicsOrigin::guess) {
    meta["fx"] = camera.fx;
    meta["fy"] = camera.fy;
    meta["cx"] = camera.cx;
    meta["cy"] = camera.cy;
  }
  if (depth_unit_mm > 0) meta["depth_unit_mm"] = depth_unit_mm;
  meta["width"] = first.size().width;
  meta["height"] = first.size().height;
  if (info.rate_hz > 0) meta["rate_hz"] = info.rate_hz;
  meta["sequence"] = info.sequence;
  if (!info.uri.empty()) meta["source"] = info.uri;
  write_file(folder / "meta.json", dump(meta, 2) + "\n");
}

TimesWriter::TimesWriter(const fs::path& file) : file_(file) { file_.append("# frame microseconds"); }

void TimesWriter::add(const Frame& frame) {
  file_.append(fmt::format("{} {}", frame.index, frame.timestamp_us));
}

DatasetWriter::DatasetWriter(fs::path folder, SourceInfo info)
    : folder_(std::move(folder)), info_(std::move(info)) {}

void DatasetWriter::add(const Frame& frame) {
  if (unit_mm_ == 0) {
    unit_mm_ = info_.depth_unit_mm > 0 ? info_.depth_unit_mm : unit_for(frame.depth_mm);
    write_meta(folder_, info_, frame, unit_mm_);
    times_.emplace(folder_ / "times.txt");
  }
  times_->add(frame);
  add_pose(frame.truth.camera_to_world);
}

// A row for each frame, from the first that has a pose on.
void DatasetWriter::add_pose(const std::optional<cv::Affine3d>& pose) {
  if (pose && !poses_) {
    poses_.emplace(folder_ / "poses.txt");
    for (std::int64_t i = 0; i < added_; ++i) poses_->append(pose_line(std::nullopt));
  }
  if (poses_) poses_->append(pose_line(pose));
  ++added_;
}

void DatasetWriter::write_depth(const Frame& frame) {
  cv::Mat1w stored;
  const DepthLosses losses = depth_to_units(frame.depth_mm, unit_mm_, stored);
  {
    const std::lock_guard lock(mutex_);
    losses_ += losses;
  }
  write_file(folder_ / frame_file(frame.index, "depth.png"), encode_png(stored));
}

void DatasetWriter::write_colour(const Frame& frame) const {
  if (!frame.colour.empty())
    write_file(folder_ / frame_file(frame.index, "rgb.png"), encode_png(frame.colour));
}

void DatasetWriter::write_truth(const Frame& frame) const {
  const GroundTruth& truth = frame.truth;
  if (!truth.labels.empty())
    write_file(folder_ / frame_file(frame.index, "label.png"), encode_png(truth.labels));
  if (!truth.classes.empty())
    write_file(folder_ / frame_file(frame.index, "class.png"), encode_png(truth.classes));
}

void DatasetWriter::finish() const {
  if (times_) times_->finish();
  if (poses_) poses_->check_in_place();
}

DepthLosses DatasetWriter::losses() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

}  // namespace saccade
