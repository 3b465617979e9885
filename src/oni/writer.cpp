#include "oni/writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/depth_units.hpp"
#include "core/error.hpp"
#include "core/frame_source.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "oni/properties.hpp"

namespace saccade {
namespace {

constexpr std::uint32_t kDepthNode = 1, kColourNode = 2;
constexpr float kFineReach_mm = kLargestStoredDepth / 10.0f;

OniCodec codec_of(OniDepthCodec codec) {
  switch (codec) {
    case OniDepthCodec::z16t:
      return OniCodec::z16t;
    case OniDepthCodec::z16p:
      return OniCodec::z16p;
    case OniDepthCodec::none:
      return OniCodec::none;
  }
  return OniCodec::none;
}

bool has_fraction(const cv::Mat1f& depth_mm) {
  return std::any_of(depth_mm.begin(), depth_mm.end(),
                     [](float depth) { return depth != std::trunc(depth); });
}

float farthest(const cv::Mat1f& depth_mm) { return *std::max_element(depth_mm.begin(), depth_mm.end()); }

std::vector<std::uint8_t> mode_bytes(cv::Size size, double rate_hz) {
  ByteBuilder mode;
  mode.put(static_cast<std::uint32_t>(size.width));
  mode.put(static_cast<std::uint32_t>(size.height));
  mode.put(static_cast<std::uint32_t>(std::lround(rate_hz >= 1 ? rate_hz : kDefaultRateHz)));
  return mode.take();
}

}  // namespace

OniWriter::OniWriter(const std::filesystem::path& path, const OniWriterOptions& options)
    : options_(options), records_(path, options.overwrite) {
  if (options.jpeg_quality < 1 || options.jpeg_quality > 100)
    throw std::invalid_argument("OniWriter: quality must be 1..100");
}

OniWriter::~OniWriter() {
  try {
    if (!closed_) close();
  } catch (const std::exception&) {
    // The file stays readable; close() reports errors.
  }
}

void OniWriter::begin(const Frame& frame) {
  size_ = frame.size();
  const auto side = static_cast<int>(kOniMaxSide);
  if (size_.empty() || size_.width > side || size_.height > side ||
      static_cast<std::uint64_t>(size_.area()) > kOniMaxPixels)
    throw failed(fmt::format("cannot record images of {} x {}", size_.width, size_.height), records_.name(),
                 "at most 8192 a side and 16 megapixels");
  origin_us_ = frame.timestamp_us;
  fine_unit_ = options_.depth_unit == OniDepthUnit::um100 ||
               (options_.depth_unit == OniDepthUnit::automatic && has_fraction(frame.depth_mm) &&
                farthest(frame.depth_mm) <= kFineReach_mm);
  has_colour_ =
      options_.colour_codec != OniColourCodec::off && (options_.expect_colour || !frame.colour.empty());
  OniNodeFields depth;
  depth.name = "Depth";
  depth.type = OniNodeType::depth;
  depth.codec = codec_of(options_.depth_codec);
  records_.add_node(kDepthNode, depth);
  add_stream(kDepthNode, frame);
  if (has_colour_) {
    OniNodeFields colour;
    colour.name = "Image";
    colour.type = OniNodeType::image;
    colour.codec = options_.colour_codec == OniColourCodec::jpeg ? OniCodec::jpeg : OniCodec::none;
    records_.add_node(kColourNode, colour);
    add_stream(kColourNode, frame);
  }
  records_.begin();
  records_.flush_folder();
  begun_ = true;
}

// The properties of a stream, in the order of README 9.
void OniWriter::add_stream(std::uint32_t id, const Frame& frame) {
  const bool depth = id == kDepthNode;
  const auto general = [&](std::string_view name, std::span<const std::uint8_t> value) {
    records_.add_property(id, OniRecordType::general_property, name, value);
  };
  const std::vector<std::uint8_t> mode = mode_bytes(size_, options_.rate_hz);
  records_.add_int(id, "oniRequiredFrameSize", static_cast<std::uint64_t>(size_.area()) * (depth ? 2 : 3));
  records_.add_int(id, "xnIsGenerating", 1);
  if (depth) records_.add_int(id, oni_property::kMaxDepth, kOniMaxDepth);
  records_.add_int(id, "xnSupportedMapOutputModesCount", 1);
  general("xnSupportedMapOutputModes", mode);
  general(oni_property::kMode, mode);
  const OniPixelFormat format = !depth       ? OniPixelFormat::rgb888
                                : fine_unit_ ? OniPixelFormat::depth_100um
                                             : OniPixelFormat::depth_1mm;
  records_.add_int(id, oni_property::kXnFormat, depth ? 4 : 1);
  records_.add_int(id, oni_property::kOniFormat, static_cast<std::uint64_t>(format));
  add_intrinsics(id, frame);
  general(oni_property::kCropping, std::array<std::uint8_t, 12>{});
  records_.add_int(id, oni_property::kMirror, 0);
  if (!depth) return;
  if (has_colour_) records_.add_int(id, oni_property::kRegistered, 1);
  ByteBuilder version;
  for (const char c : fmt::format("Saccade {}", kVersion)) version.put(c);
  version.put(char{0});
  records_.add_property(id, OniRecordType::string_property, oni_property::kWrittenBy, version.bytes());
}

// The field of view for other players, and the exact camera for Saccade.
void OniWriter::add_intrinsics(std::uint32_t id, const Frame& frame) {
  const Intrinsics& camera = frame.intrinsics;
  if (!camera.valid()) return;
  ByteBuilder fov, exact;
  fov.put(2 * std::atan(size_.width / 2.0 / camera.fx));
  fov.put(2 * std::atan(size_.height / 2.0 / camera.fy));
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) exact.put(value);
  records_.add_property(id, OniRecordType::general_property, oni_property::kFov, fov.bytes());
  records_.add_property(id, OniRecordType::general_property, oni_property::kIntrinsics, exact.bytes());
  records_.add_int(id, oni_property::kIntrinsicsGuessed, camera.origin == IntrinsicsOrigin::guess ? 1 : 0);
}

// Converts depth in mm to units, in stored_.
void OniWriter::store_depth(const cv::Mat1f& depth_mm) {
  const float steps_per_mm = fine_unit_ ? 10.0f : 1.0f;
  bool rounded = false;
  stored_.resize(depth_mm.total());
  std::size_t i = 0;
  for (const float depth : depth_mm) {
    const float steps = depth * steps_per_mm;
    const bool in_range = steps > 0 && steps < static_cast<float>(kLargestStoredDepth) + 0.5f;
    if (steps > 0 && !in_range) ++counts_.out_of_range_pixels;
    const int stored = in_range ? static_cast<int>(steps + 0.5f) : 0;
    stored_[i++] = static_cast<std::uint16_t>(stored);
    const float back = static_cast<float>(stored) / steps_per_mm;
    if (in_range && back != depth) {
      rounded = true;
      counts_.largest_rounding_mm =
          std::max(counts_.largest_rounding_mm, static_cast<double>(std::abs(back - depth)));
    }
  }
  if (rounded) ++counts_.rounded;
}

void OniWriter::encode_depth() {
  depth_payload_.clear();
  if (options_.depth_codec == OniDepthCodec::none) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(stored_.data());
    depth_payload_.assign(bytes, bytes + 2 * stored_.size());
    return;
  }
  const bool table = options_.depth_codec == OniDepthCodec::z16t;
  if (!encoder_16z_.encode(table ? Codec16z::table : Codec16z::plain, stored_, depth_payload_))
    throw failed(fmt::format("a frame's depth cannot be coded in {}", table ? "16zT" : "16zP"),
                 records_.name(), "its values are too many or too large; use --depth-codec none");
}

// False if the frame has no colour for the file.
bool OniWriter::encode_colour(const cv::Mat3b& colour) {
  if (!has_colour_) return false;
  if (colour.size() != size_) {
    ++counts_.colourless;
    return false;
  }
  colour_payload_.clear();
  if (options_.colour_codec == OniColourCodec::jpeg) {
    jpeg_.encode(colour, options_.jpeg_quality, colour_payload_);
    return true;
  }
  cv::Mat3b rgb;
  cv::cvtColor(colour, rgb, cv::COLOR_BGR2RGB);
  colour_payload_.assign(rgb.data, rgb.data + 3 * rgb.total());
  return true;
}

void OniWriter::write(const Frame& frame) {
  if (closed_) throw std::invalid_argument("OniWriter: already closed");
  if (!begun_) begin(frame);
  if (frame.size() != size_)
    throw failed(fmt::format("the image size changed from {} x {} to {} x {}", size_.width, size_.height,
                             frame.size().width, frame.size().height),
                 records_.name(), "a recording has one image size; start a new one");
  store_depth(frame.depth_mm);
  encode_depth();
  const bool with_colour = encode_colour(frame.colour);
  if (counts_.dropped != written_drops_) {
    records_.add_int(kDepthNode, oni_property::kDropped, counts_.dropped);
    written_drops_ = counts_.dropped;
  }
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(0, frame.timestamp_us - origin_us_));
  if (!records_.write_frame(kDepthNode, time, depth_payload_)) stop_for_full_disk();
  if (++counts_.frames == 1) records_.publish();
  if (with_colour && !records_.write_frame(kColourNode, time, colour_payload_)) stop_for_full_disk();
  ++counts_.unsynced;
  counts_.most_unsynced = std::max(counts_.most_unsynced, counts_.unsynced);
}

void OniWriter::sync() {
  if (counts_.unsynced == 0) return;
  records_.flush();
  counts_.unsynced = 0;
}

void OniWriter::note_dropped(std::uint64_t total) { counts_.dropped = total; }

void OniWriter::stop_for_full_disk() {
  close();
  throw failed("disk full", records_.name(),
               fmt::format("the file is closed with the {} before; free some space",
                           counted(counts_.frames, "frame")));
}

void OniWriter::add_closing_properties() {
  if (counts_.dropped != written_drops_)
    records_.add_int(kDepthNode, oni_property::kDropped, counts_.dropped);
  if (counts_.rounded != 0) records_.add_int(kDepthNode, oni_property::kRounded, counts_.rounded);
}

void OniWriter::close() {
  if (closed_) return;
  closed_ = true;
  if (counts_.frames == 0) {
    records_.remove();
    throw failed("nothing was recorded", records_.name(), "no frame arrived; the empty file was removed");
  }
  add_closing_properties();
  records_.close();
  counts_.unsynced = 0;
}

}  // namespace saccade
