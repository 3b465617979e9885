#include "oni/recording.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace saccade {
namespace {

// True if the payload of some frame could hold an image of the declared size (README 8).
bool has_plausible_frame(const Recording& recording, const OniNode& node) {
  for (std::size_t k = 0; k < node.frames.size(); ++k) {
    const OniFormat format = recording.format(node, k);
    if (format.unusable) continue;
    const std::size_t payload = node.frames[k].payload_size;
    const auto pixels = static_cast<std::size_t>(format.crop.area());
    const std::size_t bytes = pixels * bytes_per_pixel(format.pixels);
    switch (node.declared.codec) {
      case OniCodec::z16t:
      case OniCodec::z16p:
        if (may_hold_16z(payload, pixels)) return true;
        break;
      case OniCodec::none:
        // A camera's JPEG has any size.
        if (payload > 0 && payload >= bytes) return true;
        break;
      default:
        if (payload > 0) return true;
    }
  }
  return false;
}

const OniNode* first_usable(const Recording& recording, OniNodeType type) {
  const auto& nodes = recording.index().nodes;
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const OniNode& node) {
    return node.declared.type == type && has_plausible_frame(recording, node);
  });
  return found == nodes.end() ? nullptr : &*found;
}

}  // namespace

Recording::Recording(const std::filesystem::path& path) : file_(path), index_(scan_recording(file_)) {
  order_by_time();
}

Recording::Recording(int descriptor, std::string name)
    : file_(descriptor, std::move(name)), index_(scan_recording(file_)) {
  order_by_time();
}

void Recording::order_by_time() {
  const auto earlier = [](const OniFrameEntry& a, const OniFrameEntry& b) {
    return a.timestamp_us < b.timestamp_us;
  };
  by_time_.resize(index_.nodes.size());
  for (std::size_t n = 0; n < index_.nodes.size(); ++n) {
    const auto& frames = index_.nodes[n].frames;
    if (std::is_sorted(frames.begin(), frames.end(), earlier)) continue;
    by_time_[n].resize(frames.size());
    std::iota(by_time_[n].begin(), by_time_[n].end(), 0u);
    std::sort(by_time_[n].begin(), by_time_[n].end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(frames[a].timestamp_us, a) < std::pair(frames[b].timestamp_us, b);
    });
  }
}

OniFormat Recording::format(const OniNode& node, std::size_t k) const {
  return format_at(node, node.frames.at(k).payload_position);
}

Outcome Recording::read_payload(const OniFrameEntry& frame) {
  if (payload_.size() < frame.payload_size) payload_.resize(frame.payload_size);
  const std::span bytes = std::span(payload_).first(frame.payload_size);
  return file_.read(frame.payload_position, bytes) == bytes.size()
             ? Outcome::success()
             : Outcome::failure("the file cannot be read there");
}

Outcome Recording::read_stored_depth(const OniNode& node, std::size_t k, cv::Mat1w& depth) {
  const OniFrameEntry& frame = node.frames.at(k);
  if (Outcome read = read_payload(frame); !read) return read;
  return decoder_.decode_depth(node.declared.codec, format(node, k),
                               std::span(payload_).first(frame.payload_size), depth);
}

Outcome Recording::read_depth(const OniNode& node, std::size_t k, cv::Mat1f& depth_mm) {
  if (Outcome read = read_stored_depth(node, k, stored_); !read) return read;
  const std::uint64_t position = node.frames[k].payload_position;
  depth_to_mm(stored_, format_at(node, position).pixels, node.property(oni_property::kShiftToDepth, position),
              depth_mm);
  return Outcome::success();
}

Outcome Recording::read_colour(const OniNode& node, std::size_t k, cv::Mat3b& image) {
  const OniFrameEntry& frame = node.frames.at(k);
  if (Outcome read = read_payload(frame); !read) return read;
  return decoder_.decode_colour(node.declared.codec, format(node, k),
                                std::span(payload_).first(frame.payload_size), image);
}

std::optional<std::size_t> Recording::nearest(const OniNode& node, std::uint64_t timestamp_us) const {
  const auto& frames = node.frames;
  if (frames.empty()) return std::nullopt;
  const std::vector<std::uint32_t>& order =
      by_time_.at(static_cast<std::size_t>(&node - index_.nodes.data()));
  const auto frame_of = [&](std::size_t rank) { return order.empty() ? rank : std::size_t{order[rank]}; };
  std::size_t low = 0, high = frames.size();  // binary search for the first rank at or after the time
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (frames[frame_of(middle)].timestamp_us < timestamp_us)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == frames.size()) return frame_of(low - 1);
  if (low > 0 && time_between(frames[frame_of(low - 1)].timestamp_us, timestamp_us) <=
                     time_between(frames[frame_of(low)].timestamp_us, timestamp_us))
    return frame_of(low - 1);
  return frame_of(low);
}

const OniNode* main_depth(const Recording& recording) { return first_usable(recording, OniNodeType::depth); }

const OniNode* main_colour(const Recording& recording) {
  const OniNode* image = first_usable(recording, OniNodeType::image);
  return image != nullptr ? image : first_usable(recording, OniNodeType::ir);
}

}  // namespace saccade
