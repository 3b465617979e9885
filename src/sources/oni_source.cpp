#include "sources/oni_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/depth_units.hpp"
#include "core/error.hpp"
#include "core/fit_colour.hpp"
#include "core/text.hpp"
#include "sources/frame_fields.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace {

constexpr std::uint64_t kJump_us = 10'000'000;  // a larger step of time is a note

const OniNode& need_depth(const Recording& recording) {
  const OniNode* depth = main_depth(recording);
  if (depth != nullptr) return *depth;
  const auto& nodes = recording.index().nodes;
  std::string streams;
  for (const OniNode& node : nodes) {
    if (!holds_frames(node.declared.type)) continue;
    const OniFormat format = format_at(node, std::numeric_limits<std::uint64_t>::max());
    streams += fmt::format("{}{} with {}", streams.empty() ? "" : ", ", to_string(node.declared.type),
                           counted(node.frames.size(), "frame"));
    if (format.unusable) streams += fmt::format(", {}", *format.unusable);
  }
  throw unreadable("no depth frames in this recording", recording.file().name(),
                   streams.empty() ? "it holds no streams" : fmt::format("it holds {}", streams));
}

// The format of the stream's first frame that can be decoded.
OniFormat first_format(const Recording& recording, const OniNode& node) {
  for (std::size_t k = 0; k < node.frames.size(); ++k) {
    OniFormat format = recording.format(node, k);
    if (!format.unusable) return format;
  }
  return {};
}

double nominal_rate(double rate_hz) { return rate_hz > 0 ? rate_hz : kDefaultRateHz; }

// Nearest neighbours of two complete streams are at most half a period apart; the rest is for jitter.
std::uint64_t tolerance_us(double rate_hz) {
  return static_cast<std::uint64_t>(0.75e6 / nominal_rate(rate_hz));
}

}  // namespace

OniSource::OniSource(const std::filesystem::path& path, const InputSettings& settings)
    : recording_(path), depth_(&need_depth(recording_)), colour_(main_colour(recording_)) {
  fill_info(path, settings);
}

void OniSource::fill_info(const std::filesystem::path& path, const InputSettings& settings) {
  const OniFormat format = first_format(recording_, *depth_);
  info_.uri = path.string();
  info_.kind = "oni";
  info_.size = format.size;
  info_.frame_count = static_cast<std::int64_t>(depth_->frames.size());
  info_.rate_hz = format.rate_hz;
  stored_unit_mm_ = format.pixels == OniPixelFormat::depth_100um ? 0.1 : 1;
  info_.depth_unit_mm = settings.depth_unit_mm > 0 ? settings.depth_unit_mm : stored_unit_mm_;
  info_.sequence = true;
  const auto camera = intrinsics_at(*depth_, depth_->frames.front().payload_position, format.size);
  info_.intrinsics = camera.value_or(Intrinsics::guess_for(format.size));
  if (info_.intrinsics.origin == IntrinsicsOrigin::guess)
    info_.notes.push_back("the recording holds no camera calibration, so it is guessed");
  const auto& nodes = recording_.index().nodes;
  const auto depths = std::count_if(nodes.begin(), nodes.end(), [](const OniNode& node) {
    return node.declared.type == OniNodeType::depth && !node.frames.empty();
  });
  if (depths > 1) info_.notes.push_back(fmt::format("the first of {} depth streams is shown", depths));
  if (format.crop.size() != format.size)
    info_.notes.push_back(fmt::format("depth is cropped to {} x {} at ({}, {}); the rest has no reading",
                                      format.crop.width, format.crop.height, format.crop.x, format.crop.y));
  pairing_tolerance_us_ = tolerance_us(format.rate_hz);
  note_colour();
  note_times();
  note_problems();
}

void OniSource::note_colour() {
  if (colour_ == nullptr) return;
  const OniFormat format = first_format(recording_, *colour_);
  pairing_tolerance_us_ = std::max(pairing_tolerance_us_, tolerance_us(format.rate_hz));
  if (colour_->declared.type == OniNodeType::ir)
    info_.notes.push_back("no colour stream; the infrared image is shown as grey");
  if (format.size != info_.size) info_.notes.push_back(fitted_colour_note(format.size, info_.size));
  choose_pairing();
  if (depth_->int_property(oni_property::kRegistered, recording_.index().file_size).value_or(0) == 0)
    info_.notes.push_back("the recording does not say whether colour is registered to depth; assuming it is");
}

// Whether the times of a stream say nothing: they are all the same.
bool OniSource::is_timeless(const OniNode& node) {
  const auto& frames = node.frames;
  return frames.size() > 1 && std::ranges::all_of(frames, [&](const OniFrameEntry& frame) {
           return frame.timestamp_us == frames.front().timestamp_us;
         });
}

// Where no colour is near any depth in time, the streams have clocks of their own.
void OniSource::choose_pairing() {
  const auto is_near = [&](const OniFrameEntry& frame) {
    const std::size_t k = recording_.nearest(*colour_, frame.timestamp_us).value();
    return time_between(colour_->frames[k].timestamp_us, frame.timestamp_us) <= pairing_tolerance_us_;
  };
  by_order_ = colour_->frames.size() > 1 && (is_timeless(*depth_) || is_timeless(*colour_) ||
                                             std::ranges::none_of(depth_->frames, is_near));
  if (by_order_)
    info_.notes.emplace_back("the times of depth and colour do not fit: they are paired by their order");
}

void OniSource::note_times() {
  timeless_ = is_timeless(*depth_);
  if (timeless_) info_.notes.emplace_back("the frames have no times: the nominal rate is assumed");
  const auto& frames = depth_->frames;
  std::size_t jumps = 0, first = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const std::uint64_t before = frames[k - 1].timestamp_us, now = frames[k].timestamp_us;
    if (now >= before && now - before <= kJump_us) continue;
    if (jumps++ == 0) first = k;
  }
  if (jumps > 0)
    info_.notes.push_back(fmt::format("the time jumps {}, first at frame {}: by more than 10 s or backwards",
                                      jumps == 1 ? "once" : fmt::format("{} times", jumps), first));
}

void OniSource::note_problems() {
  const auto& problems = recording_.index().problems;
  std::size_t shown = 0;
  for (const OniProblem& problem : problems.list()) {
    if (problem.severity != OniSeverity::error) continue;
    if (shown++ == kMostNotes) break;
    info_.notes.push_back(fmt::format("at byte {}: {}", problem.position, problem.meaning));
  }
  const std::size_t errors = problems.count(OniSeverity::error);
  if (errors > kMostNotes)
    info_.notes.push_back(
        fmt::format("{}; saccade oni check lists them", counted(errors - kMostNotes, "more problem")));
  const auto dropped = depth_->int_property(oni_property::kDropped, recording_.index().file_size).value_or(0);
  if (dropped > 0)
    info_.notes.push_back(fmt::format("{} dropped while recording", counted(dropped, "frame")));
}

void OniSource::seek(std::int64_t index) { next_ = index < 0 ? 0 : static_cast<std::size_t>(index); }

ReadResult OniSource::read(Frame& frame, std::chrono::milliseconds) {
  if (next_ >= depth_->frames.size()) return {ReadStatus::end, {}};
  const std::size_t k = next_++;
  const OniFrameEntry& entry = depth_->frames[k];
  frame.index = static_cast<std::int64_t>(k);
  constexpr auto kLast = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  frame.timestamp_us = static_cast<std::int64_t>(std::min(entry.timestamp_us, kLast));
  if (timeless_)
    frame.timestamp_us = std::llround(static_cast<double>(k) * 1e6 / nominal_rate(info_.rate_hz));
  frame.name.clear();
  frame.truth = {};
  frame.intrinsics = info_.intrinsics;
  if (const OniFormat format = recording_.format(*depth_, k); !format.unusable && format.size != info_.size)
    return {ReadStatus::rejected, fmt::format("{} x {} instead of {} x {}", format.size.width,
                                              format.size.height, info_.size.width, info_.size.height)};
  if (const Outcome depth = recording_.read_depth(*depth_, k, frame.depth_mm); !depth)
    return {ReadStatus::rejected, fmt::format("at byte {}: {}", entry.payload_position, depth.reason())};
  if (info_.depth_unit_mm != stored_unit_mm_) {
    depth_to_units(frame.depth_mm, stored_unit_mm_, stored_);
    depth_from_units(stored_, info_.depth_unit_mm, frame.depth_mm);
  }
  if (colour_ == nullptr) {
    frame.colour.release();
    return {ReadStatus::frame, {}};
  }
  const Outcome colour = read_colour(k, frame.colour);
  if (!colour) frame.colour.release();
  return {ReadStatus::frame, colour.reason()};
}

// The colour image that belongs to a depth frame; std::nullopt if there is none.
std::optional<std::size_t> OniSource::colour_of(std::size_t depth_frame) const {
  const auto& frames = colour_->frames;
  if (by_order_) {
    // Streams of other rates keep their ratio.
    const std::size_t k = depth_frame * frames.size() / depth_->frames.size();
    return k < frames.size() ? std::optional(k) : std::nullopt;
  }
  const std::uint64_t time_us = depth_->frames[depth_frame].timestamp_us;
  const std::size_t k = recording_.nearest(*colour_, time_us).value();
  return time_between(frames[k].timestamp_us, time_us) <= pairing_tolerance_us_ ? std::optional(k)
                                                                                : std::nullopt;
}

// Copies the colour image of depth frame `depth_frame` into `colour`, in the depth's size.
Outcome OniSource::read_colour(std::size_t depth_frame, cv::Mat3b& colour) {
  const auto found = colour_of(depth_frame);
  if (!found) return Outcome::failure("no colour of that time");
  const std::size_t k = *found;
  if (shown_colour_ != k) {
    shown_colour_.reset();
    if (const Outcome read = recording_.read_colour(*colour_, k, colour_image_); !read)
      return Outcome::failure(fmt::format("colour frame {}: {}", k, read.reason()));
    shown_colour_ = k;
  }
  fit_colour(colour_image_, info_.size, colour);
  return Outcome::success();
}

namespace {
constexpr std::string_view kOniEndings[] = {".oni"};
}

extern const SourceKind kOniKind = {
    .name = "oni",
    .written = "FILE.oni",
    .help = "a recording of OpenNI 1.x or OpenNI2, also a truncated or damaged one",
    .recognised_by = "the ending, or the first bytes NI10",
    .endings = kOniEndings,
    .recognises = [](const SourceInput& input) { return input.head.starts_with("NI10"); },
    .open = [](const SourceInput& input, const SourceOptions& options) -> std::unique_ptr<FrameSource> {
      return std::make_unique<OniSource>(input.path, options.input);
    },
};

}  // namespace saccade
