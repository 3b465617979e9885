#include "output/frame_exporter.hpp"

#include <array>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/file.hpp"
#include "core/worker_pool.hpp"
#include "output/cloud_files.hpp"
#include "output/dataset_writer.hpp"
#include "output/ffv1_video.hpp"
#include "output/tum_writer.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

class FolderExporter final : public FrameExporter {
 public:
  FolderExporter(const fs::path& folder, const SourceInfo& info) : dataset_(folder, info) {}
  void add(const Frame& frame) override { dataset_.add(frame); }
  void write(const Frame& frame) override {
    dataset_.write_depth(frame);
    dataset_.write_colour(frame);
    dataset_.write_truth(frame);
  }
  void finish() override { dataset_.finish(); }
  DepthLosses losses() const override { return dataset_.losses(); }

 private:
  DatasetWriter dataset_;
};

// Clouds hold depth as floats, so that nothing is rounded to a unit.
class CloudExporter final : public FrameExporter {
 public:
  using Encode = std::vector<std::uint8_t> (*)(const Frame&);

  CloudExporter(fs::path folder, SourceInfo info, std::string_view ending, Encode encode)
      : folder_(std::move(folder)), info_(std::move(info)), ending_(ending), encode_(encode) {}

  void add(const Frame& frame) override {
    if (!times_) {
      write_meta(folder_, info_, frame, info_.depth_unit_mm);
      times_.emplace(folder_ / "times.txt");
    }
    times_->add(frame);
  }
  void write(const Frame& frame) override {
    write_file(folder_ / frame_file(frame.index, ending_), encode_(frame));
  }
  void finish() override {
    if (times_) times_->finish();
  }
  DepthLosses losses() const override { return {}; }

 private:
  fs::path folder_;
  SourceInfo info_;
  std::string_view ending_;
  Encode encode_;
  std::optional<TimesWriter> times_;
};

// FFV1 needs the frames in their order, and so add() does the work, for depth and colour at the same time.
class VideoExporter final : public FrameExporter {
 public:
  VideoExporter(fs::path folder, SourceInfo info) : folder_(std::move(folder)), info_(std::move(info)) {}

  void add(const Frame& frame) override {
    if (!depth_) begin(frame);
    times_->append(fmt::format("{} {}", position_++, frame.timestamp_us));
    const std::int64_t time_us = frame.timestamp_us - first_us_;
    encoders_.for_each(2, [&](int part, int) {
      if (part == 0)
        add_colour(frame, time_us);  // first, since it takes longer
      else
        add_depth(frame, time_us);
    });
  }
  void write(const Frame&) override {}
  void finish() override {
    if (depth_) depth_->finish();
    if (colour_) colour_->finish();
    if (times_) times_->check_in_place();
  }
  DepthLosses losses() const override { return losses_; }

 private:
  double rate_hz() const { return info_.rate_hz > 0 ? info_.rate_hz : kDefaultRateHz; }

  void begin(const Frame& frame) {
    unit_mm_ = info_.depth_unit_mm > 0 ? info_.depth_unit_mm : unit_for(frame.depth_mm);
    first_us_ = frame.timestamp_us;
    write_meta(folder_, info_, frame, unit_mm_);
    times_.emplace(folder_ / "frames_times.txt");
    times_->append("# frame microseconds");
    depth_.emplace(folder_ / "frames_depth.mkv", frame.size(), Ffv1Video::Pixels::grey16, rate_hz());
  }

  void add_depth(const Frame& frame, std::int64_t time_us) {
    losses_ += depth_to_units(frame.depth_mm, unit_mm_, stored_);
    depth_->write(stored_, time_us);
  }

  void add_colour(const Frame& frame, std::int64_t time_us) {
    if (frame.colour.empty()) return;
    if (!colour_) begin_colour(frame.size());
    colour_->write(frame.colour, time_us);
  }

  // The times of a video count from its first image. A colour video that began later than its depth would be
  // paired wrongly, and so begins with a black image.
  void begin_colour(cv::Size size) {
    colour_.emplace(folder_ / "frames_rgb.mkv", size, Ffv1Video::Pixels::bgr8, rate_hz());
    if (position_ > 1) colour_->write(cv::Mat3b(size, cv::Vec3b(0, 0, 0)), 0);
  }

  fs::path folder_;
  SourceInfo info_;
  double unit_mm_ = 1;
  std::int64_t position_ = 0, first_us_ = 0;
  std::optional<LineFile> times_;
  std::optional<Ffv1Video> depth_, colour_;
  cv::Mat1w stored_;
  DepthLosses losses_;
  WorkerPool encoders_{2};  // one for depth, one for colour; each has threads of its own
};

template <typename Exporter>
std::unique_ptr<FrameExporter> make(const fs::path& folder, const SourceInfo& info) {
  return std::make_unique<Exporter>(folder, info);
}

constexpr std::array<ExportFormat, 5> kFormats = {{
    {"folder", "numbered PNGs of depth (16 bits), colour and labels", make<FolderExporter>},
    {"tum", "as TUM RGB-D: depth/, rgb/ and the lists of their times", make<TumWriter>},
    {"ply", "a point cloud of each frame, with colour, mm",
     [](const fs::path& folder, const SourceInfo& info) -> std::unique_ptr<FrameExporter> {
       return std::make_unique<CloudExporter>(folder, info, "cloud.ply",
                                              [](const Frame& frame) { return encode_ply(frame); });
     }},
    {"pcd", "an organised point cloud of each frame, with colour, metres",
     [](const fs::path& folder, const SourceInfo& info) -> std::unique_ptr<FrameExporter> {
       return std::make_unique<CloudExporter>(folder, info, "cloud.pcd", encode_pcd);
     }},
    {"video", "lossless videos of depth and colour: FFV1 in Matroska", make<VideoExporter>},
}};

}  // namespace

std::span<const ExportFormat> export_formats() { return kFormats; }

}  // namespace saccade
