#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "sources/colour_registration.hpp"
#include "sources/video_file.hpp"

namespace saccade {

/// The titles of the streams in a recording of Azure Kinect.
inline constexpr const char* kAzureDepth = "DEPTH";
inline constexpr const char* kAzureColour = "COLOR";

/// What a recording of Azure Kinect or of a camera with its interface (Orbbec Femto) holds: a Matroska file
/// with streams of depth, infrared and colour and the calibration of the cameras.
struct AzureRecording {
  std::unique_ptr<VideoFile> colour;                 ///< its stream of colour; nullptr = none
  std::int64_t colour_delay_us = 0;                  ///< first colour image after the first depth image
  std::optional<Intrinsics> camera;                  ///< of depth; empty: the calibration is missing
  std::unique_ptr<ColourRegistration> registration;  ///< nullptr: colour cannot be registered
  std::vector<std::string> notes;                    ///< one line each
};

/// Chooses the stream of depth in `file`, from which nothing was read; nullopt if it is another video. Throws
/// Error (unreadable) if it has infrared but no depth. A calibration that is missing or damaged is a note,
/// and so is colour that cannot be read.
std::optional<AzureRecording> read_azure_recording(VideoFile& file);

/// The two cameras of a calibration.json, for depth and colour images of these sizes. Throws
/// std::runtime_error with the reason.
struct AzureCalibration {
  AzureCalibration(std::string_view json, cv::Size depth_size, cv::Size colour_size);

  LensCamera depth, colour;
  cv::Matx33d rotation;  ///< from the depth camera's axes to the colour camera's
  cv::Vec3d translation_mm;
};

}  // namespace saccade
