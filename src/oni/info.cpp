#include "oni/info.hpp"

#include <algorithm>
#include <limits>

#include "core/frame_source.hpp"

namespace saccade {
namespace {

void measure_times(const std::vector<OniFrameEntry>& frames, OniStreamInfo& stream) {
  if (frames.empty()) return;
  stream.first_us = std::numeric_limits<std::uint64_t>::max();
  const double rate_hz = stream.nominal_rate_hz > 0 ? stream.nominal_rate_hz : kDefaultRateHz;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::uint64_t now = frames[k].timestamp_us;
    stream.first_us = std::min(stream.first_us, now);
    stream.last_us = std::max(stream.last_us, now);
    stream.payload_bytes += frames[k].payload_size;
    if (k == 0) continue;
    const std::uint64_t before = frames[k - 1].timestamp_us;
    if (now < before) {
      ++stream.backward_steps;
      continue;
    }
    stream.largest_gap_us = std::max(stream.largest_gap_us, now - before);
    if (static_cast<double>(now - before) > 1.5e6 / rate_hz) ++stream.gaps;
  }
  if (stream.last_us > stream.first_us)
    stream.measured_rate_hz = static_cast<double>(frames.size() - 1) / stream.duration_s();
}

OniStreamInfo describe_stream(const OniNode& node, std::uint64_t end) {
  // The format of the first frame, or of the end of the file if there is none.
  const std::uint64_t position = node.frames.empty() ? end : node.frames.front().payload_position;
  const OniFormat format = format_at(node, position);
  OniStreamInfo stream;
  stream.node = node.id;
  stream.name = node.declared.name;
  stream.type = node.declared.type;
  stream.codec = node.declared.codec;
  stream.unusable = format.unusable;
  if (!format.unusable) stream.pixels = to_string(format.pixels);
  stream.size = format.size;
  stream.crop = format.crop;
  stream.frames = node.frames.size();
  stream.nominal_rate_hz = format.rate_hz;
  if (!format.size.empty()) stream.intrinsics = intrinsics_at(node, position, format.size);
  stream.dropped = node.int_property(oni_property::kDropped, end).value_or(0);
  measure_times(node.frames, stream);
  return stream;
}

}  // namespace

OniInfo describe(const Recording& recording) {
  const OniIndex& index = recording.index();
  OniInfo info;
  info.file = recording.file().name();
  info.size_bytes = index.file_size;
  info.version = to_string(index.header.version);
  info.closed = index.end_position != 0;
  info.lost_bytes = index.lost_bytes;
  info.errors = index.problems.count(OniSeverity::error);
  for (const OniNode& node : index.nodes)
    if (holds_frames(node.declared.type)) info.streams.push_back(describe_stream(node, index.file_size));
  return info;
}

}  // namespace saccade
