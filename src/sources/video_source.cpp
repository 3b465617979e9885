// Video files: depth with colour, or colour alone.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/depth_units.hpp"
#include "sources/colour_video.hpp"
#include "sources/depth_video.hpp"
#include "sources/frame_fields.hpp"
#include "sources/meta_json.hpp"
#include "sources/source_kind.hpp"
#include "sources/times_file.hpp"

namespace saccade {

extern const SourceKind kVideoKind;
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kEndings[] = {".mkv", ".nut",  ".mov", ".mp4",  ".m4v",
                                         ".avi", ".webm", ".mpg", ".mpeg", ".ogv"};
constexpr std::string_view kDepth = "_depth";  // ends the name of a video of depth

void take_meta(SourceInfo& info, const FolderMeta& meta) {
  info.intrinsics = meta.camera.value_or(Intrinsics::guess_for(info.size));
  info.rate_hz = meta.rate_hz.value_or(info.rate_hz);
  info.sequence = meta.sequence.value_or(true);
}

// NAME_times.txt beside NAME_depth.mkv.
fs::path times_of_video(const fs::path& path) {
  std::string stem = path.stem().string();
  if (stem.ends_with(kDepth)) stem.resize(stem.size() - kDepth.size());
  return path.parent_path() / (stem + "_times.txt");
}

// Depth, with colour where there is some.
class DepthVideoSource final : public FrameSource {
 public:
  using OpenDepth = std::function<std::unique_ptr<DepthVideo>()>;

  // `reopen` opens `depth` from its beginning.
  DepthVideoSource(const SourceInput& input, std::string_view kind, std::unique_ptr<DepthVideo> depth,
                   OpenDepth reopen, std::unique_ptr<ColourVideo> colour, const InputSettings& settings)
      : times_us_(read_times(times_of_video(input.path))),
        reopen_(std::move(reopen)),
        depth_(std::move(depth)),
        colour_(std::move(colour)) {
    info_.uri = input.uri;
    info_.kind = kind;
    info_.size = depth_->size();
    info_.rate_hz = depth_->rate_hz();
    const FolderMeta meta = read_meta(input.path.parent_path());
    info_.notes = meta.notes;
    info_.depth_unit_mm =
        settings.depth_unit_mm > 0 ? settings.depth_unit_mm : meta.depth_unit_mm.value_or(1);
    tolerance_us_ = std::llround(0.75e6 / info_.rate_hz);
    take_meta(info_, meta);
    if (!depth_->has_checksums())
      info_.notes.emplace_back("the file has no checksums: damage of its images may go unnoticed");
    if (!colour_) return;
    tolerance_us_ = std::max<std::int64_t>(tolerance_us_, std::llround(0.75e6 / colour_->rate_hz()));
    if (colour_->size() != info_.size)
      info_.notes.push_back(fmt::format("colour of {} x {} is scaled to the depth's {} x {}",
                                        colour_->size().width, colour_->size().height, info_.size.width,
                                        info_.size.height));
  }

  const SourceInfo& info() const override { return info_; }

  void seek(std::int64_t index) override { wanted_ = std::max<std::int64_t>(index, 0); }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (!go_to_wanted()) return {ReadStatus::end, ""};
    begin_frame(frame, info_, wanted_);
    try {
      ++wanted_;
      ++next_;
      if (!depth_->read(image_, frame.timestamp_us)) return {ReadStatus::end, ""};
      depth_from_units(image_, info_.depth_unit_mm, frame.depth_mm);
    } catch (const std::runtime_error& error) {
      return {ReadStatus::rejected, fmt::format("frame {}: {}", frame.index, error.what())};
    }
    const bool has_colour = colour_ && colour_->nearest(frame.timestamp_us, tolerance_us_, colour_image_);
    if (const auto time = times_us_.find(frame.index); time != times_us_.end())
      frame.timestamp_us = time->second;
    if (!has_colour) {
      frame.colour.release();
      return {ReadStatus::frame, colour_ ? "no colour of that time" : ""};
    }
    if (colour_image_.size() == info_.size)
      colour_image_.copyTo(frame.colour);
    else
      cv::resize(colour_image_, frame.colour, info_.size, 0, 0, cv::INTER_AREA);
    return {ReadStatus::frame, ""};
  }

 private:
  bool go_to_wanted() {
    if (wanted_ < next_) {
      depth_ = reopen_();
      next_ = 0;
    }
    for (; next_ < wanted_; ++next_)
      if (!depth_->skip()) return false;
    return true;
  }

  SourceInfo info_;
  std::map<std::int64_t, std::int64_t> times_us_;  // of the list beside it, which is finer than the container
  OpenDepth reopen_;
  std::unique_ptr<DepthVideo> depth_;
  std::unique_ptr<ColourVideo> colour_;  // nullptr = none
  std::int64_t tolerance_us_ = 0, wanted_ = 0, next_ = 0;
  cv::Mat1w image_;
  cv::Mat3b colour_image_;
};

// Colour without depth.
class ColourVideoSource final : public FrameSource {
 public:
  ColourVideoSource(const SourceInput& input, std::string_view kind)
      : path_(input.path), video_(std::make_unique<ColourVideo>(path_)) {
    info_.uri = input.uri;
    info_.kind = kind;
    info_.size = video_->size();
    info_.rate_hz = video_->rate_hz();
    info_.has_depth = false;
    info_.notes.emplace_back(kNoDepthNote);
    take_meta(info_, read_meta(path_.parent_path()));
  }

  const SourceInfo& info() const override { return info_; }
  void seek(std::int64_t index) override { wanted_ = std::max<std::int64_t>(index, 0); }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (wanted_ < next_) {
      video_ = std::make_unique<ColourVideo>(path_);
      next_ = 0;
    }
    for (; next_ < wanted_; ++next_)
      if (!video_->skip()) return {ReadStatus::end, ""};
    begin_frame(frame, info_, wanted_);
    try {
      ++wanted_;
      ++next_;
      if (!video_->read(frame.colour, frame.timestamp_us)) return {ReadStatus::end, ""};
      if (frame.colour.size() != info_.size) throw std::runtime_error("another size than the first image");
    } catch (const std::runtime_error& error) {
      return {ReadStatus::rejected, fmt::format("frame {}: {}", frame.index, error.what())};
    }
    set_no_depth(frame, info_.size);
    return {ReadStatus::frame, ""};
  }

 private:
  fs::path path_;
  std::unique_ptr<ColourVideo> video_;
  SourceInfo info_;
  std::int64_t wanted_ = 0, next_ = 0;
};

// The video NAME_rgb.* beside NAME_depth.*; nullptr if there is none.
std::unique_ptr<ColourVideo> colour_of_video(const fs::path& path) {
  std::string stem = path.stem().string();
  if (!stem.ends_with(kDepth)) return nullptr;
  stem.resize(stem.size() - kDepth.size());
  std::error_code code;
  for (const std::string_view ending : kEndings)
    if (const fs::path colour = path.parent_path() / (stem + "_rgb").append(ending);
        fs::is_regular_file(colour, code))
      return std::make_unique<ColourVideo>(colour);
  return nullptr;
}

}  // namespace

extern const SourceKind kVideoKind = {
    .name = "video",
    .written = "FILE.mkv",
    .help = "a video of 16-bit depth with its colour beside it; any other video as colour without depth",
    .recognised_by = "the ending",
    .endings = kEndings,
    .open = [](const SourceInput& input, const SourceOptions& options) -> std::unique_ptr<FrameSource> {
      const auto open = [path = input.path] { return open_depth_video(path); };
      auto depth = open();
      if (!depth) return std::make_unique<ColourVideoSource>(input, kVideoKind.name);
      auto colour = colour_of_video(input.path);
      return std::make_unique<DepthVideoSource>(input, kVideoKind.name, std::move(depth), open,
                                                std::move(colour), options.input);
    },
};

}  // namespace saccade
