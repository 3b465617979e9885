// Recordings of ROS: .bag, .mcap, .db3, and the folders in which ROS 2 keeps them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fit_colour.hpp"
#include "sources/bag_topics.hpp"
#include "sources/folder_files.hpp"
#include "sources/frame_fields.hpp"
#include "sources/ros_messages.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kBagEndings[] = {".bag", ".mcap", ".db3"};

// By the lower quartile of the distances of the stamps, since messages may be missing.
double measure_rate_hz(const std::vector<BagMessage>& messages) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < messages.size(); ++i)
    if (messages[i].stamp_ns > messages[i - 1].stamp_ns)
      steps.push_back(messages[i].stamp_ns - messages[i - 1].stamp_ns);
  if (steps.empty()) return kDefaultRateHz;
  const auto quartile = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 4);
  std::ranges::nth_element(steps, quartile);
  return 1e9 / static_cast<double>(*quartile);
}

class BagSource final : public FrameSource {
 public:
  BagSource(const SourceInput& input, std::string_view kind, std::unique_ptr<BagFile> file,
            const InputSettings& settings, std::vector<std::string> notes)
      : file_(std::move(file)) {
    info_.notes = std::move(notes);
    std::vector<BagStream> streams = list_streams(*file_);
    if (const auto& problems = file_->problems();
        !problems.empty() && !std::ranges::any_of(streams, &BagStream::is_depth))
      throw unreadable("no depth is left in this damaged file; " + problems.front(), input.uri,
                       "copy it again, or choose another");
    const ChosenStreams chosen = choose_streams(streams, settings, input.uri);
    depth_ = std::move(streams[chosen.depth]);
    if (chosen.colour) colour_ = std::move(streams[*chosen.colour]);
    unit_mm_ = settings.depth_unit_mm;
    info_.uri = input.uri;
    info_.kind = kind;
    info_.sequence = true;
    info_.frame_count = static_cast<std::int64_t>(depth_.messages.size());
    info_.rate_hz = measure_rate_hz(depth_.messages);
    info_.size = first_size();
    info_.depth_unit_mm = depth_.encoding.starts_with("32FC1") ? 0 : unit_mm_ > 0 ? unit_mm_ : 1;
    info_.intrinsics = Intrinsics::guess_for(info_.size);
    if (chosen.camera) read_camera(streams[*chosen.camera]);
    tolerance_ns_ = std::llround(0.75e9 / info_.rate_hz);
    if (colour_)
      tolerance_ns_ =
          std::max<std::int64_t>(tolerance_ns_, std::llround(0.75e9 / measure_rate_hz(colour_->messages)));
    note_topics(chosen, streams);
    note_problems();
  }

  const SourceInfo& info() const override { return info_; }
  void seek(std::int64_t index) override { next_ = std::max<std::int64_t>(index, 0); }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (next_ >= *info_.frame_count) return {ReadStatus::end, ""};
    begin_frame(frame, info_, next_);
    const BagMessage& message = depth_.messages[static_cast<std::size_t>(next_++)];
    frame.timestamp_us = message.stamp_ns / 1000;
    try {
      ros_depth(read_ros_image(file_->read(message.place), depth_.topic), unit_mm_, frame.depth_mm);
      if (frame.size() != info_.size)
        throw std::runtime_error(fmt::format("{}x{} instead of {}x{}", frame.size().width,
                                             frame.size().height, info_.size.width, info_.size.height));
    } catch (const std::runtime_error& error) {
      return {ReadStatus::rejected, error.what()};
    }
    return {ReadStatus::frame, read_colour(message.stamp_ns, frame.colour)};
  }

 private:
  // That of the first depth image whose header can be used.
  cv::Size first_size() {
    std::string problem;
    for (const BagMessage& message : depth_.messages) try {
        return ros_depth_size(read_ros_image(file_->read(message.place), depth_.topic));
      } catch (const std::runtime_error& error) {
        if (problem.empty()) problem = error.what();
      }
    throw unreadable("no depth image can be read, the first: " + problem, info_.uri,
                     "other topics can be chosen with --topics");
  }

  void read_camera(const BagStream& stream) {
    try {
      if (const auto camera = read_ros_camera(file_->read(stream.messages.front().place), stream.topic))
        take_camera(*camera, stream.topic.name);
    } catch (const std::runtime_error& error) {
      info_.notes.push_back(fmt::format("{}: {}", stream.topic.name, error.what()));
    }
  }

  // Of a rectified topic (image_rect), the distortion has been taken out, and the camera is another one.
  void take_camera(const RosCamera& camera, const std::string& topic) {
    const bool rectified =
        depth_.topic.name.find("image_rect") != std::string::npos && camera.rectified.valid();
    const cv::Size size = camera.lens.size;
    const double across = static_cast<double>(info_.size.width) / std::max(size.width, 1),
                 down = static_cast<double>(info_.size.height) / std::max(size.height, 1);
    if (!size.empty() && std::abs(across / down - 1) > 0.02) {
      info_.notes.push_back(fmt::format("the camera of {} is not used: it is of images of {} x {}", topic,
                                        size.width, size.height));
      return;
    }
    info_.intrinsics = rectified ? camera.rectified : camera.lens.pinhole;
    if (!size.empty() && size != info_.size) {
      info_.intrinsics = scaled_camera(info_.intrinsics, across, down);
      info_.notes.push_back(fmt::format("the camera of {} is of images of {} x {} and is scaled", topic,
                                        size.width, size.height));
    }
    if (rectified || !camera.distorted) return;
    if (!camera.knows_distortion) {
      info_.notes.push_back(fmt::format("the distortion of the depth camera's lens ({}) stays in the depth",
                                        camera.distortion_model.substr(0, 40)));
      return;
    }
    LensCamera lens = camera.lens;
    lens.size = info_.size;
    lens.pinhole = info_.intrinsics;
    info_.notes.push_back(distortion_note(lens));
  }

  void note_topics(const ChosenStreams& chosen, const std::vector<BagStream>& streams) {
    std::string text = "depth from " + depth_.topic.name;
    if (colour_) text += ", colour from " + colour_->topic.name;
    if (chosen.camera) text += ", camera from " + streams[*chosen.camera].topic.name;
    info_.notes.push_back(text);
    const std::string& name = depth_.topic.name;
    if (colour_ && name.find("aligned") == std::string::npos && name.find("registered") == std::string::npos)
      info_.notes.emplace_back("the topics do not say whether colour is registered to depth; assuming it is");
  }

  void note_problems() {
    const auto& problems = file_->problems();
    for (std::size_t i = 0; i < std::min(problems.size(), kMostNotes); ++i)
      info_.notes.push_back(problems[i]);
    if (problems.size() > kMostNotes)
      info_.notes.push_back(fmt::format("{} more problems", problems.size() - kMostNotes));
  }

  // The colour nearest in time, scaled to the depth's size; returns why there is none.
  std::string read_colour(std::int64_t stamp_ns, cv::Mat3b& colour) {
    colour.release();
    if (!colour_) return "";
    const auto& messages = colour_->messages;
    auto nearest = std::ranges::lower_bound(messages, stamp_ns, {}, &BagMessage::stamp_ns);
    if (nearest == messages.end() ||
        (nearest != messages.begin() &&
         stamp_ns - std::prev(nearest)->stamp_ns <= nearest->stamp_ns - stamp_ns))
      --nearest;
    if (std::abs(nearest->stamp_ns - stamp_ns) > tolerance_ns_) return "no colour of that time";
    try {
      const cv::Mat3b image = ros_colour(read_ros_image(file_->read(nearest->place), colour_->topic));
      if (image.size() == info_.size)
        colour = image;  // of this message alone: no copy is needed
      else
        fit_colour(image, info_.size, colour);
      return "";
    } catch (const std::runtime_error& error) {
      return fmt::format("no colour: {}", error.what());
    }
  }

  std::unique_ptr<BagFile> file_;
  SourceInfo info_;
  BagStream depth_;
  std::optional<BagStream> colour_;
  double unit_mm_ = 0;  // that the user named; 0 = none
  std::int64_t tolerance_ns_ = 0, next_ = 0;
};

bool is_bag(const fs::path& file) {
  return std::ranges::count(kBagEndings, std::string_view(ending_of(file))) > 0;
}

// "NAME.mcap.zstd": the recorder of ROS 2 can compress its files as a whole.
bool is_packed_bag(const fs::path& file) { return ending_of(file) == ".zstd" && is_bag(file.stem()); }

bool is_ros2(const SourceInput& input) {
  std::error_code code;
  if (input.type == SourceInput::Type::file) return is_packed_bag(input.path);
  if (input.type != SourceInput::Type::folder || !fs::exists(input.path / "metadata.yaml", code))
    return false;
  for (fs::directory_iterator file(input.path, code), end; !code && file != end; file.increment(code))
    if (is_bag(file->path()) || is_packed_bag(file->path())) return true;
  return false;
}

std::unique_ptr<BagFile> open_bag(const fs::path& path) {
  if (is_packed_bag(path))
    throw unreadable("the file is compressed as a whole", path.string(), "decompress it: zstd -d FILE");
  const std::string ending = ending_of(path);
  if (ending == ".mcap") return open_mcap(path);
  return ending == ".db3" ? open_db3(path) : open_ros1_bag(path);
}

// The recording in the folder of a ROS 2 bag: of one file, or split into several (NAME_0, NAME_1, ...). A
// part that cannot be read is a note as long as another can.
std::unique_ptr<BagFile> open_ros2_folder(const fs::path& folder, std::vector<std::string>& notes) {
  std::vector<BagPart> parts;
  std::optional<Error> first_error;
  auto files = files_of(folder, {std::begin(kBagEndings), std::end(kBagEndings)});
  for (const auto& [stem, path] : files_of(folder, {".zstd"}))
    if (is_packed_bag(path))
      files.emplace(fs::path(stem).stem().string(), path);  // unless it is there unpacked
  for (const auto& [stem, path] : files) try {
      parts.push_back({path.filename().string(), open_bag(path)});
    } catch (const Error& error) {
      notes.emplace_back(error.what());
      if (!first_error) first_error = error;
    }
  if (parts.empty()) throw *first_error;
  return parts.size() == 1 && !first_error ? std::move(parts[0].file) : join_bags(std::move(parts));
}

}  // namespace

extern const SourceKind kBagKind = {
    .name = "bag",
    .written = "FILE.bag",
    .help =
        "a recording of ROS 1 (.bag) or ROS 2 (.mcap, .db3, or its folder); --topics chooses among several",
    .recognised_by = "metadata.yaml beside an .mcap or .db3",
    .endings = kBagEndings,
    .recognises = is_ros2,
    .open = [](const SourceInput& input, const SourceOptions& options) -> std::unique_ptr<FrameSource> {
      std::vector<std::string> notes;
      auto file = input.type == SourceInput::Type::folder ? open_ros2_folder(input.path, notes)
                                                          : open_bag(input.path);
      return std::make_unique<BagSource>(input, kBagKind.name, std::move(file), options.input,
                                         std::move(notes));
    },
    .has_topics = true,
};

}  // namespace saccade
