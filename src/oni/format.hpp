#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace saccade {

/// The .oni container (README 1 and 2): a 24-byte file header, then records back to back. Everything is
/// little-endian and packed; positions are byte offsets from the start of the file; times are microseconds.

constexpr std::array<char, 4> kOniFileMagic = {'N', 'I', '1', '0'}, kOniRecordMagic = {'N', 'I', 'R', '\0'};
constexpr std::size_t kOniHeaderSize = 24;
constexpr std::size_t kOniMaxRecordHeader = 28;
constexpr std::size_t kOniFrameFields = 12;  ///< u64 timestamp, u32 number, after the header of NEW_DATA
constexpr std::uint32_t kOniNoCount = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kOniNoTime = std::numeric_limits<std::uint64_t>::max();

/// Bounds of untrusted numbers (README 8).
constexpr std::uint64_t kOniMaxFields = 1u << 20;
constexpr std::uint64_t kOniMaxPayload = 64u << 20;
constexpr std::uint32_t kOniMaxName = 256;
constexpr std::uint32_t kOniMaxSide = 8192;          ///< px
constexpr std::uint64_t kOniMaxPixels = 16'000'000;  ///< of one image
/// In an image of more pixels, a crop must be at least 1/kOniMaxCropRatio of it, so that a frame of a few
/// bytes cannot demand a huge image.
constexpr std::uint64_t kOniFreeCropPixels = std::uint64_t{1600} * 1200;
constexpr std::uint64_t kOniMaxCropRatio = 64;
constexpr std::size_t kOniMaxNodes = 64;
constexpr std::size_t kOniMaxFrames = 5'000'000;        ///< in one file
constexpr std::size_t kOniMaxChanges = 4096;            ///< of properties, per node
constexpr std::size_t kOniMaxPropertyBytes = 1u << 20;  ///< per node
constexpr std::uint32_t kOniMaxPropertySize = 131072;

enum class OniRecordType : std::uint32_t {
  node_added_1004 = 0x02,
  int_property = 0x03,
  real_property = 0x04,
  string_property = 0x05,
  general_property = 0x06,
  node_removed = 0x07,
  data_begin = 0x08,
  state_ready = 0x09,
  new_data = 0x0A,
  end = 0x0B,
  node_added_1005 = 0x0C,
  node_added = 0x0D,
  seek_table = 0x0E,
};

enum class OniNodeType : std::int32_t { device = 1, depth = 2, image = 3, audio = 4, ir = 5 };

enum class OniCodec : std::uint32_t {
  none = 0x454E4F4E,  ///< "NONE": pixels without coding
  z16t = 0x547A3631,  ///< "16zT": 16-bit symbols with a table of values
  z16p = 0x507A3631,  ///< "16zP": 16-bit symbols
  z8 = 0x7A386D49,    ///< "Im8z": 8-bit symbols
  jpeg = 0x4745504A,  ///< "JPEG"
};

enum class OniPixelFormat : std::uint32_t {
  depth_1mm = 100,
  depth_100um = 101,
  shift_9_2 = 102,
  shift_9_3 = 103,
  rgb888 = 200,
  yuv422 = 201,  ///< U Y0 V Y1
  grey8 = 202,
  grey16 = 203,
  jpeg = 204,  ///< the camera's own JPEG, of any size
  yuyv = 205,  ///< Y0 U Y1 V
};

bool is_property(OniRecordType type);
bool is_node_added(OniRecordType type);
/// Depth, image and IR nodes hold frames; others are skipped.
bool holds_frames(OniNodeType type);
bool holds_depth(OniPixelFormat format);
/// 0 for a JPEG of the camera, which has no fixed size.
std::size_t bytes_per_pixel(OniPixelFormat format);

/// "depth", "image", "ir", "device", "audio", "other".
std::string_view to_string(OniNodeType type);
/// "16zT", "NONE", ...; an unknown one as hexadecimal.
std::string to_string(OniCodec codec);
std::string_view to_string(OniPixelFormat format);
std::string to_string(OniRecordType type);
/// The pixel format with that number; absent for an unknown one.
std::optional<OniPixelFormat> pixel_format_of(std::uint64_t number);
bool is_known(OniCodec codec);

struct OniVersion {
  std::uint8_t major_part = 1, minor_part = 0;
  std::uint16_t maintenance = 1;
  std::uint32_t build = 0;
  auto operator<=>(const OniVersion&) const = default;
};

struct OniFileHeader {
  OniVersion version;
  std::uint64_t max_timestamp = kOniNoTime;
  std::uint32_t max_node_id = 0;

  /// Versions before 1.0.1.0 have 32-bit positions: shorter record headers and table entries.
  bool narrow() const { return version < OniVersion{1, 0, 1, 0}; }
  std::size_t record_header_size() const { return narrow() ? 24 : 28; }
  std::size_t table_entry_size() const { return narrow() ? 16 : 20; }
};

/// The header in the first 24 bytes; absent if they are fewer or without the magic. Any version.
std::optional<OniFileHeader> parse_file_header(std::span<const std::uint8_t> bytes);
/// From 1.0.0.4 to 1.0.1.0.
bool is_supported(const OniVersion& version);
std::string to_string(const OniVersion& version);

/// One record, as its header declares it; not checked against the file.
struct OniRecord {
  std::uint64_t position = 0;
  OniRecordType type{};
  std::uint32_t node = 0;
  std::uint32_t fields_size = 0;  ///< bytes of header and fields
  std::uint32_t payload_size = 0;
  std::uint64_t undo = 0;
  // Of NEW_DATA only:
  std::uint64_t timestamp_us = 0;
  std::uint32_t number = 0;

  std::uint64_t payload_position() const { return position + fields_size; }
  std::uint64_t end() const { return payload_position() + payload_size; }
};

/// The record header at the start of `bytes`, with the fields of NEW_DATA; absent without the magic, or if
/// `bytes` or fields_size are too short for it.
std::optional<OniRecord> parse_record(const OniFileHeader& file, std::uint64_t position,
                                      std::span<const std::uint8_t> bytes);

/// The fields of a NODE_ADDED record.
struct OniNodeFields {
  std::string name;
  OniNodeType type{};
  OniCodec codec{};
  std::uint32_t frames = kOniNoCount;
  std::uint64_t min_timestamp_us = 0, max_timestamp_us = kOniNoTime;
  std::uint64_t table_position = 0;
};

/// Reads the fields after the record header; absent if they are truncated or the name is no string.
std::optional<OniNodeFields> parse_node_added(const OniFileHeader& file, OniRecordType type,
                                              std::span<const std::uint8_t> fields);

/// Name and value of a property record; the value points into `fields`.
struct OniPropertyFields {
  std::string name;
  std::span<const std::uint8_t> value;
};
std::optional<OniPropertyFields> parse_property(std::span<const std::uint8_t> fields);

}  // namespace saccade
