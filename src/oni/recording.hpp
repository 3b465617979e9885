#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/outcome.hpp"
#include "oni/image_decoder.hpp"
#include "oni/index.hpp"
#include "oni/input_file.hpp"
#include "oni/properties.hpp"

namespace saccade {

/// An .oni recording, opened for reading: any frame of any stream, in any order. Opening scans the records of
/// the whole file once and skips their payloads (README 5). A file that is unclosed, truncated or damaged in
/// the middle still gives every complete frame; index().problems lists the damage.
/// Frame k of a node is the k-th in the file, from 0; access takes constant time.
/// Thread safety: one call at a time per object.
class Recording {
 public:
  /// Throws Error (unreadable) if the file cannot be read or is no .oni recording.
  explicit Recording(const std::filesystem::path& path);
  /// The same for an open descriptor, which the object then owns; `name` is for messages.
  Recording(int descriptor, std::string name);

  const OniIndex& index() const { return index_; }
  const InputFile& file() const { return file_; }

  /// The format of frame k of a node of this recording.
  OniFormat format(const OniNode& node, std::size_t k) const;

  /// Decodes frame k of a depth node to its stored numbers, in the full image size, 0 outside the crop. Fails
  /// for a bad frame, and `depth` is then undefined.
  Outcome read_stored_depth(const OniNode& node, std::size_t k, cv::Mat1w& depth);
  /// The same in mm, 0 = no reading.
  Outcome read_depth(const OniNode& node, std::size_t k, cv::Mat1f& depth_mm);
  /// Decodes frame k of an image or IR node as BGR in the full image size, black outside the crop. Fails for
  /// a bad frame, and `image` is then undefined.
  Outcome read_colour(const OniNode& node, std::size_t k, cv::Mat3b& image);

  /// The frame of `node` whose time is nearest to `timestamp_us`, the earlier of two equally near; absent if
  /// the node has no frames. O(log n), even if the times in the file are not in order.
  std::optional<std::size_t> nearest(const OniNode& node, std::uint64_t timestamp_us) const;

 private:
  void order_by_time();
  Outcome read_payload(const OniFrameEntry& frame);

  InputFile file_;
  OniIndex index_;
  std::vector<std::vector<std::uint32_t>> by_time_;  // of each node; empty = its times are in order
  OniImageDecoder decoder_;
  std::vector<std::uint8_t> payload_;
  cv::Mat1w stored_;
};

/// The depth stream to show: the first depth node with a frame that may hold an image; nullptr = none.
const OniNode* main_depth(const Recording& recording);
/// The stream whose images go with the depth: the first image node of that kind, else the first IR node;
/// nullptr = none.
const OniNode* main_colour(const Recording& recording);

/// The absolute difference of two times of a file, us.
constexpr std::uint64_t time_between(std::uint64_t a, std::uint64_t b) { return a < b ? b - a : a - b; }

}  // namespace saccade
