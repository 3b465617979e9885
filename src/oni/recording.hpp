#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "oni/image_decoder.hpp"
#include "oni/index.hpp"
#include "oni/input_file.hpp"
#include "oni/properties.hpp"

namespace saccade {

/// An .oni recording, opened for reading: any frame of any stream, in any order. Opening scans the whole file
/// once, without its payloads. A file that was not closed, was cut, or is damaged in the middle gives all
/// frames that are whole; index().problems says what is wrong.
/// Frame k of a node is its k-th one in the file, from 0; finding it takes constant time.
/// Thread safety: one call at a time per object.
class Recording {
 public:
  /// Throws Error (unreadable) if the file cannot be read or is no .oni recording.
  explicit Recording(const std::filesystem::path& path);
  /// The same for an open descriptor, which is taken over; `name` is for messages.
  Recording(int descriptor, std::string name);

  const OniIndex& index() const { return index_; }
  const InputFile& file() const { return file_; }

  /// The format of frame k of a node of this recording.
  OniFormat format(const OniNode& node, std::size_t k) const;

  /// Decodes frame k of a depth node: the stored numbers, in the full image size, 0 where cropping left a
  /// pixel out. Returns why the frame is bad; empty = it is good.
  std::string read_stored_depth(const OniNode& node, std::size_t k, cv::Mat1w& depth);
  /// The same in mm, 0 = no reading.
  std::string read_depth(const OniNode& node, std::size_t k, cv::Mat1f& depth_mm);
  /// Decodes frame k of an image or IR node as BGR in the full image size.
  std::string read_colour(const OniNode& node, std::size_t k, cv::Mat3b& image);

  /// The frame of `node` whose time is nearest to `timestamp_us`, the earlier of two equally near; absent if
  /// the node has none. O(log n), also where the times in the file are not in order.
  std::optional<std::size_t> nearest(const OniNode& node, std::uint64_t timestamp_us) const;

 private:
  void order_by_time();
  std::string read_payload(const OniFrameEntry& frame);

  InputFile file_;
  OniIndex index_;
  std::vector<std::vector<std::uint32_t>> by_time_;  // of each node; empty = its times are in order
  OniImageDecoder decoder_;
  std::vector<std::uint8_t> payload_;
  cv::Mat1w stored_;
};

/// The stream that shows the scene's depth: the first depth node with a frame that may be decoded; nullptr if
/// there is none.
const OniNode* main_depth(const Recording& recording);
/// The stream whose pictures go with the depth: the first usable image node, else the first usable IR node.
const OniNode* main_colour(const Recording& recording);

/// The absolute difference of two times of a file.
constexpr std::uint64_t time_between(std::uint64_t a, std::uint64_t b) { return a < b ? b - a : a - b; }

}  // namespace saccade
