#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/frame_source.hpp"
#include "core/input_settings.hpp"
#include "core/outcome.hpp"
#include "oni/recording.hpp"

namespace saccade {

/// Frames of an .oni recording, by Saccade's own reader. Each frame of the first depth stream is a frame; a
/// damaged one is `rejected`, and the next may be good.
///
/// Colour is the frame of the first image stream (or, where there is none, of the infrared stream as grey)
/// that is nearest to the depth in time, at most 3/4 of a nominal frame period of the slower stream away (25
/// ms at 30 Hz, which also holds where the file names no rate); beyond that, or where it is damaged, the
/// frame has no colour, and ReadResult::reason says why. Colour of another size is scaled to the depth's,
/// which is exact only for cameras with one field of view; info().notes says so. Pixels outside of a cropped
/// image have no reading.
///
/// Where the times of the two streams do not fit (all are equal, or none is near another), colour is paired
/// by its number. Timestamps are those of the file, or if these are all equal, of the nominal rate. seek()
/// takes constant time.
class OniSource final : public FrameSource {
 public:
  /// Throws Error (unreadable) if the file is no recording or holds no depth frame that can be decoded.
  explicit OniSource(const std::filesystem::path& path, const InputSettings& settings = {});

  const SourceInfo& info() const override { return info_; }
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override;
  void seek(std::int64_t index) override;

 private:
  void fill_info(const std::filesystem::path& path, const InputSettings& settings);
  void note_colour();
  void note_times();
  void note_problems();
  static bool is_timeless(const OniNode& node);
  void choose_pairing();
  std::optional<std::size_t> colour_of(std::size_t depth_frame) const;
  Outcome read_colour(std::size_t depth_frame, cv::Mat3b& colour);

  Recording recording_;
  const OniNode* depth_ = nullptr;
  const OniNode* colour_ = nullptr;  // nullptr = the recording has none
  std::uint64_t pairing_tolerance_us_ = 0;
  bool by_order_ = false;  // colour is paired by its number, since the times do not fit
  bool timeless_ = false;  // all depth frames have one time
  std::size_t next_ = 0;
  std::optional<std::size_t> shown_colour_;  // the frame that colour_image_ holds
  cv::Mat3b colour_image_;
  double stored_unit_mm_ = 1;  // of the file
  cv::Mat1w stored_;
  SourceInfo info_;
};

}  // namespace saccade
