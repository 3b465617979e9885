#include "sources/open_source.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "drivers/openni2/openni2_source.hpp"
#include "sources/folder_source.hpp"
#include "sources/nyu_source.hpp"
#include "sources/oni_source.hpp"
#include "sources/synthetic_source.hpp"
#include "sources/video_source.hpp"

namespace saccade {

std::unique_ptr<FrameSource> open_source(const std::string& uri, const SensorSettings& sensor) {
  if (uri == "openni2" || uri.starts_with("openni2:")) return std::make_unique<OpenNi2Source>(uri, sensor);
  if (uri.starts_with("synthetic:")) return std::make_unique<SyntheticSource>(uri);
  if (uri.starts_with("v4l2:")) return open_webcam(uri);
  if (is_image_pattern(uri)) return open_image_sequence(uri);
  if (std::filesystem::is_directory(uri)) return open_folder(uri);
  if (std::filesystem::path(uri).extension() == ".oni") return std::make_unique<OniSource>(uri);
  if (std::filesystem::exists(uri) && std::filesystem::path(uri).extension() == ".mat") return open_nyu(uri);
  if (std::filesystem::exists(uri) && is_video_name(uri)) return open_video(uri);
  if (std::filesystem::exists(uri))
    throw unreadable(
        "not a kind of file that can be read", uri,
        "a folder of images, an .oni recording, a video or the .mat of NYU Depth V2 is expected");
  throw unreadable(
      "no such source", uri,
      "openni2, a folder of images, FILE.oni, FILE.mkv, FILE.mat, depth_%04d.png, v4l2:DEVICE or "
      "synthetic:NAME");
}

}  // namespace saccade
