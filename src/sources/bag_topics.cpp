#include "sources/bag_topics.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "sources/numbered_frames.hpp"
#include "sources/ros_messages.hpp"

namespace saccade {
namespace {

using Index = std::optional<std::size_t>;

bool is_image(const BagTopic& topic) {
  return topic.type == "sensor_msgs/Image" || topic.type == "sensor_msgs/CompressedImage";
}

// `part` in lower case; names are of any.
bool has(const std::string& name, std::string_view part) {
  return lower_case(name).find(part) != std::string::npos;
}

std::string names_of(const std::vector<BagStream>& streams, bool BagStream::*kind) {
  std::string text;
  for (const BagStream& stream : streams)
    if (stream.*kind) text += (text.empty() ? "" : ", ") + stream.topic.name;
  return text;
}

std::size_t common_beginning(const std::string& a, const std::string& b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

// The stream of the topic that the user named.
std::size_t named(const std::vector<BagStream>& streams, const std::string& name, bool BagStream::*kind,
                  const char* key) {
  const auto found =
      std::ranges::find_if(streams, [&](const BagStream& stream) { return stream.topic.name == name; });
  if (found == streams.end() || !((*found).*kind))
    throw usage_error(fmt::format("no topic of this name has {}", key),
                      fmt::format("--topics {}={}", key, name),
                      fmt::format("there are: {}", names_of(streams, kind)));
  return static_cast<std::size_t>(found - streams.begin());
}

// How likely a stream is the one that is meant; the higher, the better.
int rank_of_depth(const BagStream& stream) {
  const std::string& name = stream.topic.name;
  const bool registered = has(name, "aligned_depth_to_color") || has(name, "depth_registered");
  const bool raw = stream.topic.type == "sensor_msgs/Image";
  return (registered ? 4 : 0) + (has(name, "depth") ? 2 : 0) + (raw ? 1 : 0);
}

std::size_t choose_depth(const std::vector<BagStream>& streams, const std::string& file) {
  Index best;
  bool tie = false;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!streams[i].is_depth) continue;
    const int rank = rank_of_depth(streams[i]), before = best ? rank_of_depth(streams[*best]) : -1;
    tie = rank == before || (tie && rank < before);
    if (rank > before) best = i;
  }
  if (!best) {
    std::string held;
    for (const BagStream& stream : streams) {
      if (!held.empty()) held += ", ";
      const std::string& what = stream.encoding.empty() ? stream.problem : stream.encoding;
      held += stream.topic.name + (what.empty() ? "" : " (" + what.substr(0, 80) + ")");
    }
    throw unreadable("no topic of depth (16UC1, mono16, 32FC1 or compressedDepth)", file,
                     held.empty() ? "it holds no images" : "it holds " + held);
  }
  if (tie)
    throw unreadable("several topics could be the depth", file,
                     "choose with --topics depth=TOPIC: " + names_of(streams, &BagStream::is_depth));
  return *best;
}

Index choose_beside(const std::vector<BagStream>& streams, bool BagStream::*kind, const std::string& depth) {
  const auto rank = [&](const BagStream& stream) {
    const std::string& name = stream.topic.name;
    const bool infrared = has(name, "infra") || has(name, "/ir");
    const bool colour = stream.is_colour && (has(name, "color") || has(name, "colour") || has(name, "rgb"));
    return (infrared ? 0 : 10'000) + (colour ? 1000 : 0) +
           static_cast<int>(std::min<std::size_t>(common_beginning(name, depth), 400)) * 2 +
           (stream.topic.type == "sensor_msgs/Image" ? 1 : 0);
  };
  Index best;
  for (std::size_t i = 0; i < streams.size(); ++i)
    if (streams[i].*kind && !streams[i].is_depth && (!best || rank(streams[i]) > rank(streams[*best])))
      best = i;
  return best;
}

}  // namespace

std::vector<BagStream> list_streams(BagFile& file) {
  std::vector<BagStream> streams;
  file.scan([&](std::size_t topic, std::int64_t time_ns, BagFile::Bytes beginning, const BagPlace& place) {
    if (streams.size() <= topic) streams.resize(topic + 1);
    BagStream& stream = streams[topic];
    if (stream.messages.empty()) stream.topic = file.topics()[topic];
    BagMessage message{time_ns, place};
    if (is_image(stream.topic)) try {
        const RosImage image = read_ros_image_header(beginning, stream.topic);
        if (image.stamp_ns > 0) message.stamp_ns = image.stamp_ns;
        if (stream.encoding.empty()) {
          stream.encoding = image.encoding;
          stream.is_depth = image.is_depth();
          stream.is_colour = image.is_colour();
        }
      } catch (const std::runtime_error& error) {  // it is given again when the message is read
        if (stream.problem.empty()) stream.problem = error.what();
      }
    stream.is_camera = stream.topic.type == "sensor_msgs/CameraInfo";
    if (is_image(stream.topic) || stream.is_camera) stream.messages.push_back(message);
  });
  for (BagStream& stream : streams) std::ranges::stable_sort(stream.messages, {}, &BagMessage::stamp_ns);
  std::erase_if(streams, [](const BagStream& stream) { return stream.messages.empty(); });
  return streams;
}

ChosenStreams choose_streams(const std::vector<BagStream>& streams, const InputSettings& settings,
                             const std::string& file) {
  ChosenStreams chosen;
  chosen.depth = settings.depth_topic.empty()
                     ? choose_depth(streams, file)
                     : named(streams, settings.depth_topic, &BagStream::is_depth, "depth");
  const std::string& depth = streams[chosen.depth].topic.name;
  chosen.colour = settings.colour_topic.empty()
                      ? choose_beside(streams, &BagStream::is_colour, depth)
                      : named(streams, settings.colour_topic, &BagStream::is_colour, "colour");
  chosen.camera = settings.camera_topic.empty()
                      ? choose_beside(streams, &BagStream::is_camera, depth)
                      : named(streams, settings.camera_topic, &BagStream::is_camera, "camera");
  return chosen;
}

}  // namespace saccade
