#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "oni/format.hpp"

namespace saccade {

struct OniNode;

/// Names of the properties that Saccade reads (README 3). The last ones are its own; other players skip them.
namespace oni_property {
constexpr std::string_view kMode = "xnMapOutputMode";      ///< u32 width, height, frames a second
constexpr std::string_view kXnFormat = "xnPixelFormat";    ///< 1 RGB24, 2 YUV422, 3 grey 8, 4 grey 16, 5 JPEG
constexpr std::string_view kOniFormat = "oniPixelFormat";  ///< OniPixelFormat; takes precedence
constexpr std::string_view kMaxDepth = "xnDeviceMaxDepth";             ///< largest depth value
constexpr std::string_view kFov = "xnFOV";                             ///< f64 horizontal, vertical, radians
constexpr std::string_view kRealWorld = "xnRealWorldTranslationData";  ///< f64 zero plane, pixel size, ratio
constexpr std::string_view kCropping = "xnCropping";           ///< u32 enabled, u16 x, y, width, height
constexpr std::string_view kMirror = "xnMirror";               ///< the pixels are stored mirrored already
constexpr std::string_view kShiftToDepth = "S2D";              ///< u16 depth in mm of each raw shift
constexpr std::string_view kIntrinsics = "saccadeIntrinsics";  ///< f64 fx, fy, cx, cy
constexpr std::string_view kIntrinsicsGuessed = "saccadeIntrinsicsGuessed";  ///< int 1 = those are a guess
constexpr std::string_view kRegistered = "saccadeRegistered";  ///< int 1 = colour is registered to depth
constexpr std::string_view kDropped = "saccadeDroppedFrames";  ///< int, frames captured and not written
constexpr std::string_view kRounded = "saccadeRoundedFrames";  ///< int, frames with depth that was rounded
constexpr std::string_view kWrittenBy = "saccadeVersion";      ///< string, the program that wrote the file
}  // namespace oni_property

/// The value of oni_property::kMaxDepth in files that Saccade writes; readings reach kLargestStoredDepth.
constexpr std::uint64_t kOniMaxDepth = 65535;

/// The sizes that the value of a known property may have, bytes.
struct OniPropertySize {
  std::size_t least = 0, most = 0, step = 1;
  bool allows(std::size_t size) const { return size >= least && size <= most && size % step == 0; }
};

/// Absent for a property that the reader does not use.
std::optional<OniPropertySize> known_property_size(std::string_view name);

/// The format of the frames of a stream at one position of the file (README 3.1 and 3.2).
struct OniFormat {
  cv::Size size;       ///< the full image, px
  cv::Rect crop;       ///< the part that a frame holds, px; the full image where cropping is off
  double rate_hz = 0;  ///< nominal, 0 = unknown
  OniPixelFormat pixels = OniPixelFormat::depth_1mm;
  std::optional<std::string> unusable;  ///< why frames cannot be decoded; absent = they can
};

/// The format at `position`. Every number of the file is checked against its bound (README 8).
OniFormat format_at(const OniNode& node, std::uint64_t position);

/// The declared part of the image that frames at `position` hold, unchecked; absent if cropping is off.
std::optional<cv::Rect> cropping_at(const OniNode& node, std::uint64_t position);

/// True if the part is not empty and lies within the image. Its numbers are 0..65535.
bool fits_in(const cv::Rect& part, cv::Size size);

/// The camera of a stream (README 3.3): from Saccade's own property (exact), the field of view, or the
/// zero-plane data of old files; absent if the file has none that is valid. A recorded guess stays a guess.
/// `size`: full image, px.
std::optional<Intrinsics> intrinsics_at(const OniNode& node, std::uint64_t position, cv::Size size);

}  // namespace saccade
