#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "core/input_settings.hpp"
#include "sources/source_kind.hpp"

namespace saccade {

/// One frame of a folder: its files, not yet opened.
struct FolderEntry {
  std::string name;                               ///< "0007", or the time stamp in a TUM folder
  std::int64_t timestamp_us = 0;                  ///< of the folder's own list, or from the first frame
  std::filesystem::path depth, colour, label;     ///< colour and label may be empty
  std::filesystem::path classes{};                ///< may be empty
  std::vector<std::filesystem::path> masks{};     ///< instead of `label`: an image of each object, 0 = not it
  std::optional<cv::Affine3d> camera_to_world{};  ///< as in GroundTruth
  std::optional<Intrinsics> intrinsics{};         ///< of this frame; none: the camera of the folder
};

/// The frames that a folder layout finds, in their order.
struct FolderListing {
  std::vector<FolderEntry> entries;    ///< not empty
  double mm_per_unit = 1;              ///< of depth images, unless meta.json or the user says otherwise
  double rate_hz = 30;                 ///< unless meta.json says otherwise
  bool sequence = false;               ///< as in SourceInfo, unless meta.json says otherwise
  std::vector<std::string> notes{};    ///< as in SourceInfo
  std::filesystem::path cloud{};       ///< an organised point cloud, which shows the camera; may be empty
  bool colours_are_labels = false;     ///< each colour but black of a label image is an object
  bool rotated_bits = false;           ///< depth images are rotated left by 3 bits (SUN RGB-D)
  std::optional<Intrinsics> camera{};  ///< that the layout names; meta.json overrides it
};

/// Opens the frames of `listing`, found in `folder`, as a source of kind `kind`. Depth is a 16-bit
/// grey PNG, or z of an organised PCD or PLY, whose colours are those of the frame if it has no colour image;
/// label and class images are grey or palette. Every frame has the size of the first that is usable. The
/// camera is that of meta.json (read_meta()), else of the layout, else the one that fits the points of the
/// cloud, else a guess. A frame whose depth cannot be used is rejected with the reason. Colour of another
/// size is scaled; colour, labels or classes that cannot be used leave the frame without them, and
/// ReadResult::reason says why. Throws Error (unreadable): no depth image is usable, meta.json is broken.
std::unique_ptr<FrameSource> open_folder(const SourceInput& input, const std::filesystem::path& folder,
                                         std::string_view kind, FolderListing listing,
                                         const InputSettings& settings);

}  // namespace saccade
