#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "oni/codec_16z.hpp"
#include "oni/jpeg.hpp"
#include "oni/record_writer.hpp"

namespace saccade {

enum class OniDepthCodec { z16t, z16p, none };
enum class OniColourCodec { jpeg, none, off };
/// The unit of stored depth. `automatic`: 0.1 mm if the first frame has fractions of a millimetre and no
/// depth beyond 6553.5 mm, else 1 mm.
enum class OniDepthUnit { automatic, mm1, um100 };

struct OniWriterOptions {
  OniDepthCodec depth_codec = OniDepthCodec::z16t;
  OniColourCodec colour_codec = OniColourCodec::jpeg;
  OniDepthUnit depth_unit = OniDepthUnit::automatic;
  int jpeg_quality = 90;  ///< 1..100
  double rate_hz = 0;     ///< nominal, 0 = unknown: writes 30, since players need a number
  /// Adds a colour stream even if the first frame has no colour; for cameras whose colour starts later.
  bool expect_colour = false;
  bool overwrite = false;
};

/// Counts of a recording.
struct OniWriterCounts {
  std::uint64_t frames = 0;   ///< written
  std::uint64_t dropped = 0;  ///< the number of note_dropped()
  std::uint64_t rounded = 0;  ///< frames with depth that is no multiple of the unit
  double largest_rounding_mm = 0;
  std::uint64_t out_of_range_pixels = 0;  ///< too far for the unit; stored as no reading
  std::uint64_t colourless = 0;           ///< frames without colour although the file has a colour stream
  std::uint64_t unsynced = 0;             ///< written frames that a power failure now would take
  std::uint64_t most_unsynced = 0;        ///< the largest value of `unsynced` so far
};

/// Records frames to an .oni file (README 9) that survives the program: a process killed at any moment loses
/// at most the frame being written, and a full disk leaves a closed file of all frames before. A power
/// failure takes only frames after the last sync().
///
/// Depth in multiples of the unit is stored bit for bit: integer millimetres up to 65534 in a 1 mm file,
/// tenths up to 6553.4 mm in a 0.1 mm file. Other depth (a synthetic scene without a sensor's quantisation)
/// is rounded to the unit; such frames are counted and noted in the file. Times are relative to the first
/// frame, with one origin for depth and colour. Camera, drops and rounding are stored as properties that
/// other players skip. Thread safety: one call at a time per object.
class OniWriter {
 public:
  /// Creates the file, still empty. One that it replaces stays until the first frame is written. Throws Error
  /// (usage) if it exists and is not to be overwritten, Error (failed) if it cannot be created;
  /// std::invalid_argument for a quality out of range.
  OniWriter(const std::filesystem::path& path, const OniWriterOptions& options);
  /// Closes the file if close() was not called, and ignores errors; removes a file without a frame.
  ~OniWriter();
  OniWriter(const OniWriter&) = delete;
  OniWriter& operator=(const OniWriter&) = delete;

  /// Writes a frame. It then survives the process, and a power failure after sync(). The first frame decides
  /// the size, the unit and whether there is colour. Throws Error (failed): the disk is full, after closing
  /// the file with all frames before; the size differs from the first frame's, or the codec cannot hold the
  /// depth (more than 32768 distinct values in 16zT, a jump to 32768 or more in 16zP).
  /// In the last two cases the file is unchanged.
  void write(const Frame& frame);

  /// Waits until all written frames are on the disk. Throws Error (failed).
  void sync();

  /// Sets the number of captured frames that will not be written, so far; stored in the file.
  void note_dropped(std::uint64_t total);

  /// Closes the file. Throws Error (failed), also if no frame was written; the file is then removed.
  void close();

  const OniWriterCounts& counts() const { return counts_; }
  std::uint64_t size_bytes() const { return records_.size(); }

 private:
  void begin(const Frame& frame);
  void add_stream(std::uint32_t id, const Frame& frame);
  void add_intrinsics(std::uint32_t id, const Frame& frame);
  void store_depth(const cv::Mat1f& depth_mm);
  void encode_depth();
  bool encode_colour(const cv::Mat3b& colour);
  void add_closing_properties();
  [[noreturn]] void stop_for_full_disk();

  OniWriterOptions options_;
  OniRecordWriter records_;
  OniWriterCounts counts_;
  bool begun_ = false, closed_ = false, has_colour_ = false;
  bool fine_unit_ = false;  // 0.1 mm
  cv::Size size_;
  std::int64_t origin_us_ = 0;
  std::uint64_t written_drops_ = 0;
  Encoder16z encoder_16z_;
  JpegCodec jpeg_;
  std::vector<std::uint16_t> stored_;
  std::vector<std::uint8_t> depth_payload_, colour_payload_;
};

}  // namespace saccade
