#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/frame_source.hpp"

namespace saccade {

/// True for names that say that they are a video: .mkv, .nut, .mov, .mp4, .avi, ...
bool is_video_name(const std::filesystem::path& path);

/// True for numbered images: a PNG with one printf number, e.g. depth_%04d.png.
bool is_image_pattern(const std::string& text);

/// Opens a video file. One of 16-bit depth (see open_depth_video()), in mm, gives depth; if it is called
/// NAME_depth.*, the colour is that of NAME_rgb.* beside it, nearest in time and at most 3/4 of a frame
/// period away, scaled to the depth's size. Any other video gives colour and, since there is no depth, a
/// depth without a reading; info().has_depth is false and a note says so. The camera is that of meta.json in
/// the same folder (fx fy cx cy), else a guess. The number of frames is not known before the end, as
/// containers do not tell it exactly. Throws Error (unreadable).
std::unique_ptr<FrameSource> open_video(const std::filesystem::path& path);

/// Opens numbered images of depth (see open_depth_images()), colour being the image whose name has "rgb" in
/// the place of "depth" (.png or .jpg). Throws Error (unreadable).
std::unique_ptr<FrameSource> open_image_sequence(const std::string& pattern);

/// Opens "v4l2:/dev/video0": a plain camera, colour without depth, live. Throws Error (unreadable) if it
/// cannot be used; read() throws Error (failed) when it is lost.
std::unique_ptr<FrameSource> open_webcam(const std::string& uri);

}  // namespace saccade
