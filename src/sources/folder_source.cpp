#include "sources/folder_source.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fit_colour.hpp"
#include "sources/folder_images.hpp"
#include "sources/meta_json.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// Why a file cannot be used. An Error names the file itself.
std::string reason_of(const fs::path& file, const std::runtime_error& error) {
  return dynamic_cast<const Error*>(&error) != nullptr
             ? error.what()
             : fmt::format("{}: {}", file.filename().string(), error.what());
}

class FolderSource final : public FrameSource {
 public:
  FolderSource(const SourceInput& input, const fs::path& folder, std::string_view kind, FolderListing listing,
               const InputSettings& settings)
      : listing_(std::move(listing)) {
    info_.uri = input.uri;
    info_.kind = kind;
    info_.size = first_size();
    info_.frame_count = static_cast<std::int64_t>(listing_.entries.size());
    info_.notes = listing_.notes;
    const FolderMeta meta = read_meta(folder);
    info_.notes.insert(info_.notes.end(), meta.notes.begin(), meta.notes.end());
    info_.rate_hz = meta.rate_hz.value_or(listing_.rate_hz);
    info_.sequence = meta.sequence.value_or(listing_.sequence);
    set_unit(meta, settings);
    auto camera = meta.camera ? meta.camera : listing_.camera;
    if (!camera) camera = camera_of_cloud();
    info_.intrinsics = camera ? *camera : Intrinsics::guess_for(info_.size);
    note_scaled_colour();
  }

  const SourceInfo& info() const override { return info_; }

  void seek(std::int64_t index) override { next_ = index; }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (next_ < 0 || next_ >= info_.frame_count) return {ReadStatus::end, ""};
    const FolderEntry& entry = listing_.entries[static_cast<std::size_t>(next_)];
    frame.index = next_++;
    frame.timestamp_us = entry.timestamp_us;
    frame.name = entry.name;
    frame.intrinsics = entry.intrinsics.value_or(info_.intrinsics);
    frame.truth = {};
    frame.truth.camera_to_world = entry.camera_to_world;
    try {
      read_depth_file(entry.depth, info_.size, form_, frame.depth_mm, frame.colour);
    } catch (const std::runtime_error& error) {  // an Error, or the reason of a decoder
      return {ReadStatus::rejected, reason_of(entry.depth, error)};
    }
    return {ReadStatus::frame, read_companions(entry, frame)};
  }

 private:
  // All frames have one size: that of the first whose header makes sense.
  cv::Size first_size() const {
    std::optional<Error> problem;  // the first
    for (const FolderEntry& entry : listing_.entries) try {
        return read_depth_size(entry.depth);
      } catch (const Error& error) {
        if (!problem) problem = error;
      } catch (const std::runtime_error& error) {
        if (!problem) problem = no_depth(reason_of(entry.depth, error));
      }
    throw problem.value_or(no_depth("it is empty"));
  }

  Error no_depth(const std::string& why) const {
    return unreadable("no usable depth image; " + why, info_.uri,
                      "depth must be 16-bit grey PNG or an organised PCD or PLY, at least 8 pixels a side");
  }

  void set_unit(const FolderMeta& meta, const InputSettings& settings) {
    const bool clouds = is_cloud(listing_.entries.front().depth);
    const double given = settings.depth_unit_mm;
    form_.mm_per_unit = given > 0 ? given : meta.depth_unit_mm.value_or(listing_.mm_per_unit);
    form_.rotated_bits = listing_.rotated_bits;
    if (given > 0) form_.mm_per_real = given;
    if (given == 0) form_.cloud_unit_mm = meta.depth_unit_mm.value_or(0);
    info_.depth_unit_mm = clouds ? form_.cloud_unit_mm : form_.mm_per_unit;
  }

  // By the first colour image that can be read, among a few: all may be missing.
  void note_scaled_colour() {
    int tries = 10;
    for (const FolderEntry& entry : listing_.entries) try {
        if (entry.colour.empty()) continue;
        if (tries-- == 0) return;
        if (const cv::Size size = ColourReader::read_size(entry.colour); size != info_.size)
          info_.notes.push_back(fitted_colour_note(size, info_.size));
        return;
      } catch (const std::runtime_error&) {
        // The frame's reason is given when it is read.
      }
  }

  std::optional<Intrinsics> camera_of_cloud() {
    if (listing_.cloud.empty()) return std::nullopt;
    try {
      return read_cloud_camera(listing_.cloud);
    } catch (const std::runtime_error& error) {
      info_.notes.push_back(reason_of(listing_.cloud, error));
      return std::nullopt;
    }
  }

  // Fills colour, labels and classes as far as they can be read; returns why some cannot.
  std::string read_companions(const FolderEntry& entry, Frame& frame) {
    std::string problems;
    const auto attempt = [&](const char* what, const fs::path& path, auto read) {
      if (path.empty()) return;
      try {
        read();
      } catch (const std::runtime_error& error) {
        problems += fmt::format("{}no {}: {}", problems.empty() ? "" : "; ", what, reason_of(path, error));
      }
    };
    if (!entry.colour.empty()) frame.colour.release();
    attempt("colour", entry.colour, [&] { frame.colour = colour_.read(entry.colour, info_.size); });
    attempt("labels", entry.label, [&] {
      frame.truth.labels = read_label_image(entry.label, info_.size, listing_.colours_are_labels);
    });
    if (!entry.masks.empty())
      attempt("labels", entry.masks.front(),
              [&] { frame.truth.labels = read_masks(entry.masks, info_.size); });
    attempt("classes", entry.classes,
            [&] { frame.truth.classes = read_label_image(entry.classes, info_.size, false); });
    return problems;
  }

  FolderListing listing_;
  SourceInfo info_;
  DepthForm form_;
  ColourReader colour_;
  std::int64_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_folder(const SourceInput& input, const fs::path& folder,
                                         std::string_view kind, FolderListing listing,
                                         const InputSettings& settings) {
  return std::make_unique<FolderSource>(input, folder, kind, std::move(listing), settings);
}

}  // namespace saccade
