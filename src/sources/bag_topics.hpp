#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/input_settings.hpp"
#include "sources/bag_file.hpp"

namespace saccade {

/// A message of a topic.
struct BagMessage {
  std::int64_t stamp_ns = 0;  ///< of its header; where that is 0, of the recording
  BagPlace place;
};

/// A topic of a bag and its messages in the order of their stamps.
struct BagStream {
  BagTopic topic;
  bool is_depth = false, is_colour = false, is_camera = false;
  std::string encoding;  ///< of its first image; empty: it cannot be read
  std::string problem;   ///< why
  std::vector<BagMessage> messages;
};

/// What a bag holds of images and cameras, by one pass over it.
std::vector<BagStream> list_streams(BagFile& file);

/// The streams that make frames, as indices.
struct ChosenStreams {
  std::size_t depth = 0;
  std::optional<std::size_t> colour, camera;
};

/// Chooses by the topics that the user names, else by type and name: depth that is registered to colour
/// before other depth, raw images before compressed ones, and colour and camera with the most of the depth's
/// name in theirs. Throws Error: (unreadable) there is no depth, or several topics could
/// be it, which it names; (usage) a topic that the user names is not there or of another type.
ChosenStreams choose_streams(const std::vector<BagStream>& streams, const InputSettings& settings,
                             const std::string& file);

}  // namespace saccade
