#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "sources/source_kind.hpp"

namespace saccade {

/// One frame of a folder: its files, not yet opened.
struct FolderEntry {
  std::string name;                               ///< "0007", or the time stamp in a TUM folder
  std::int64_t timestamp_us = 0;                  ///< from the first frame
  std::filesystem::path depth, colour, label;     ///< colour and label may be empty
  std::filesystem::path classes{};                ///< may be empty
  std::optional<cv::Affine3d> camera_to_world{};  ///< as in GroundTruth
};

/// The frames that a folder layout finds, in their order.
struct FolderListing {
  std::vector<FolderEntry> entries;  ///< not empty
  double mm_per_unit = 1;            ///< of depth images
  double rate_hz = 30;
  bool sequence = false;             ///< as in SourceInfo
  std::vector<std::string> notes{};  ///< as in SourceInfo
  std::filesystem::path cloud{};     ///< an organised point cloud, which shows the camera; may be empty
  bool colours_are_labels = false;   ///< each colour but black of a label image is an object
  bool scales_colour = false;  ///< to the depth's size; else a frame with colour of another size is rejected
};

/// Opens the frames of `listing`, found in `folder`, as a source of kind `kind`. Depth is a 16-bit
/// grey PNG, or z of an organised PCD; label and class images are grey or palette. Every frame has the size
/// of the first that is usable. The camera is that of meta.json (read_meta()), else the one that fits the
/// points of the cloud, else a guess. A frame that cannot be used is rejected with the reason. Throws Error
/// (unreadable): no depth image is usable, meta.json is broken.
std::unique_ptr<FrameSource> open_folder(const SourceInput& input, const std::filesystem::path& folder,
                                         std::string_view kind, FolderListing listing);

}  // namespace saccade
