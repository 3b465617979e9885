// Video files: depth with colour, or colour alone.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/depth_units.hpp"
#include "core/error.hpp"
#include "core/fit_colour.hpp"
#include "sources/azure_recording.hpp"
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

constexpr std::string_view kVideoEndings[] = {".mkv", ".nut",  ".mov", ".mp4",  ".m4v",
                                              ".avi", ".webm", ".mpg", ".mpeg", ".ogv"};
constexpr std::string_view kDepth = "_depth";  // ends the name of a video of depth

void take_meta(SourceInfo& info, const FolderMeta& meta,
               const std::optional<Intrinsics>& camera_of_file = {}) {
  info.intrinsics = meta.camera ? *meta.camera : camera_of_file.value_or(Intrinsics::guess_for(info.size));
  info.rate_hz = meta.rate_hz.value_or(info.rate_hz);
  info.sequence = meta.sequence.value_or(true);
}

// NAME_times.txt beside NAME_depth.mkv.
fs::path times_of_video(const fs::path& path) {
  std::string stem = path.stem().string();
  if (stem.ends_with(kDepth)) stem.resize(stem.size() - kDepth.size());
  return path.parent_path() / (stem + "_times.txt");
}

// What a source of depth reads.
struct DepthAndColour {
  std::string title;  // of the stream of depth, as in VideoFile
  std::unique_ptr<DepthVideo> depth;
  std::unique_ptr<ColourVideo> colour;               // nullptr = none
  std::int64_t colour_delay_us = 0;                  // its first image after that of depth
  std::unique_ptr<ColourRegistration> registration;  // nullptr: colour is only scaled
  std::optional<Intrinsics> camera;                  // that the file names
  std::vector<std::string> notes;
};

// Depth, with colour where there is some.
class DepthVideoSource final : public FrameSource {
 public:
  DepthVideoSource(const SourceInput& input, std::string_view kind, DepthAndColour parts,
                   const InputSettings& settings)
      : times_us_(read_times(times_of_video(input.path))),
        path_(input.path),
        title_(std::move(parts.title)),
        depth_(std::move(parts.depth)),
        colour_(std::move(parts.colour)),
        colour_delay_us_(parts.colour_delay_us),
        registration_(std::move(parts.registration)) {
    info_.uri = input.uri;
    info_.kind = kind;
    info_.size = depth_->size();
    info_.rate_hz = depth_->rate_hz();
    const FolderMeta meta = read_meta(input.path.parent_path());
    info_.notes = std::move(parts.notes);
    info_.notes.insert(info_.notes.end(), meta.notes.begin(), meta.notes.end());
    info_.depth_unit_mm =
        settings.depth_unit_mm > 0 ? settings.depth_unit_mm : meta.depth_unit_mm.value_or(1);
    tolerance_us_ = std::llround(0.75e6 / info_.rate_hz);
    take_meta(info_, meta, parts.camera);
    if (!depth_->has_checksums())
      info_.notes.emplace_back("the file has no checksums: damage of its images may go unnoticed");
    if (!colour_) return;
    tolerance_us_ = std::max<std::int64_t>(tolerance_us_, std::llround(0.75e6 / colour_->rate_hz()));
    if (registration_ && registration_->colour_size() != colour_->size()) registration_.reset();
    if (!registration_ && colour_->size() != info_.size)
      info_.notes.push_back(fitted_colour_note(colour_->size(), info_.size));
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
      return {ReadStatus::rejected, error.what()};
    }
    const bool has_colour =
        colour_ && colour_->nearest(frame.timestamp_us - colour_delay_us_, tolerance_us_, colour_image_);
    if (const auto time = times_us_.find(frame.index); time != times_us_.end())
      frame.timestamp_us = time->second;
    if (!has_colour) {
      frame.colour.release();
      return {ReadStatus::frame, colour_ ? "no colour of that time" : ""};
    }
    if (registration_)
      registration_->apply(frame.depth_mm, colour_image_, frame.colour);
    else
      fit_colour(colour_image_, info_.size, frame.colour);
    return {ReadStatus::frame, ""};
  }

 private:
  bool go_to_wanted() {
    if (wanted_ < next_) {
      depth_ = open_depth_video(std::make_unique<VideoFile>(path_, title_));
      next_ = 0;
    }
    for (; next_ < wanted_; ++next_)
      if (!depth_->skip()) return false;
    return true;
  }

  SourceInfo info_;
  std::map<std::int64_t, std::int64_t> times_us_;  // of the list beside it, which is finer than the container
  fs::path path_;
  std::string title_;  // of the stream of depth
  std::unique_ptr<DepthVideo> depth_;
  std::unique_ptr<ColourVideo> colour_;
  std::int64_t colour_delay_us_ = 0;
  std::unique_ptr<ColourRegistration> registration_;
  std::int64_t tolerance_us_ = 0, wanted_ = 0, next_ = 0;
  cv::Mat1w image_;
  cv::Mat3b colour_image_;
};

// Colour without depth.
class ColourVideoSource final : public FrameSource {
 public:
  ColourVideoSource(const SourceInput& input, std::string_view kind, std::unique_ptr<VideoFile> file)
      : path_(input.path), video_(std::make_unique<ColourVideo>(std::move(file))) {
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
      video_ = std::make_unique<ColourVideo>(std::make_unique<VideoFile>(path_));
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
      return {ReadStatus::rejected, error.what()};
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
  for (const std::string_view ending : kVideoEndings)
    if (const fs::path colour = path.parent_path() / (stem + "_rgb").append(ending);
        fs::is_regular_file(colour, code))
      return std::make_unique<ColourVideo>(std::make_unique<VideoFile>(colour));
  return nullptr;
}

// Depth does not need its colour: if it cannot be read, that is a note.
template <typename Open>
void open_colour(DepthAndColour& parts, Open open) {
  try {
    parts.colour = open();
  } catch (const Error& error) {
    parts.notes.push_back(fmt::format("no colour: {}", error.what()));
  }
}

// The streams of one recording.
DepthAndColour parts_of(std::unique_ptr<VideoFile> file, AzureRecording recording) {
  DepthAndColour parts;
  parts.title = kAzureDepth;
  parts.depth = open_depth_video(std::move(file));
  parts.notes = std::move(recording.notes);
  if (recording.colour)
    open_colour(parts, [&] { return std::make_unique<ColourVideo>(std::move(recording.colour)); });
  parts.colour_delay_us = recording.colour_delay_us;
  parts.registration = std::move(recording.registration);
  parts.camera = recording.camera;
  return parts;
}

DepthAndColour parts_of(std::unique_ptr<VideoFile> file) {
  DepthAndColour parts;
  open_colour(parts, [&] { return colour_of_video(file->path()); });
  parts.depth = open_depth_video(std::move(file));
  return parts;
}

}  // namespace

extern const SourceKind kVideoKind = {
    .name = "video",
    .written = "FILE.mkv",
    .help =
        "a recording of Azure Kinect; a video of 16-bit depth, its colour beside it; any other video as "
        "colour",
    .recognised_by = "the ending",
    .endings = kVideoEndings,
    .open = [](const SourceInput& input, const SourceOptions& options) -> std::unique_ptr<FrameSource> {
      auto file = std::make_unique<VideoFile>(input.path);
      auto recording = read_azure_recording(*file);
      if (!recording && !holds_depth(*file))
        return std::make_unique<ColourVideoSource>(input, kVideoKind.name, std::move(file));
      DepthAndColour parts =
          recording ? parts_of(std::move(file), std::move(*recording)) : parts_of(std::move(file));
      return std::make_unique<DepthVideoSource>(input, kVideoKind.name, std::move(parts), options.input);
    },
};

}  // namespace saccade
