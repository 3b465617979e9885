#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "sources/open_source.hpp"

namespace saccade {

/// The frame of `saccade bench`: a table with a Kinect's noise, a fifth of it missing.
inline const std::string kBenchTable = "synthetic:table?seed=1&noise=kinect&missing=0.2&frames=1";

/// The first frames of a source, at most `most`, each with memory of its own. None if it is a file or folder
/// that is not there. Throws std::runtime_error if it has none.
inline std::vector<Frame> read_frames(const std::string& uri,
                                      std::size_t most = std::numeric_limits<std::size_t>::max()) {
  if (uri.starts_with('/') && !std::filesystem::exists(uri)) return {};
  const auto source = open_source(uri);
  std::vector<Frame> frames;
  for (Frame frame; frames.size() < most; frame = Frame()) {
    if (source->read(frame, std::chrono::seconds(1)).status != ReadStatus::frame) break;
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw std::runtime_error(uri + " has no frame");
  return frames;
}

/// The path of data beside the project, of which there may be none: "kitchen_sequence".
inline std::string shared_data(const std::string& name) { return SACCADE_SHARED_DIR "/data/" + name; }

}  // namespace saccade
