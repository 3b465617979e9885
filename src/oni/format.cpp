#include "oni/format.hpp"

#include <cstring>

#include <fmt/format.h>

#include "oni/bytes.hpp"

namespace saccade {

bool is_property(OniRecordType type) {
  return type >= OniRecordType::int_property && type <= OniRecordType::general_property;
}

bool is_node_added(OniRecordType type) {
  return type == OniRecordType::node_added || type == OniRecordType::node_added_1005 ||
         type == OniRecordType::node_added_1004;
}

bool holds_frames(OniNodeType type) {
  return type == OniNodeType::depth || type == OniNodeType::image || type == OniNodeType::ir;
}

bool holds_depth(OniPixelFormat format) { return format <= OniPixelFormat::shift_9_3; }

std::size_t bytes_per_pixel(OniPixelFormat format) {
  switch (format) {
    case OniPixelFormat::rgb888:
      return 3;
    case OniPixelFormat::grey8:
      return 1;
    case OniPixelFormat::jpeg:
      return 0;
    default:
      return 2;
  }
}

std::string_view to_string(OniNodeType type) {
  switch (type) {
    case OniNodeType::device:
      return "device";
    case OniNodeType::depth:
      return "depth";
    case OniNodeType::image:
      return "image";
    case OniNodeType::audio:
      return "audio";
    case OniNodeType::ir:
      return "ir";
  }
  return "other";
}

bool is_known(OniCodec codec) {
  switch (codec) {
    case OniCodec::none:
    case OniCodec::z16t:
    case OniCodec::z16p:
    case OniCodec::z8:
    case OniCodec::jpeg:
      return true;
  }
  return false;
}

std::string to_string(OniCodec codec) {
  if (!is_known(codec)) return fmt::format("0x{:08x}", static_cast<std::uint32_t>(codec));
  std::string text(4, ' ');
  std::memcpy(text.data(), &codec, 4);
  return text;
}

std::string_view to_string(OniPixelFormat format) {
  switch (format) {
    case OniPixelFormat::depth_1mm:
      return "depth 1 mm";
    case OniPixelFormat::depth_100um:
      return "depth 100 um";
    case OniPixelFormat::shift_9_2:
      return "shift 9.2";
    case OniPixelFormat::shift_9_3:
      return "shift 9.3";
    case OniPixelFormat::rgb888:
      return "RGB888";
    case OniPixelFormat::yuv422:
      return "YUV422";
    case OniPixelFormat::grey8:
      return "grey 8";
    case OniPixelFormat::grey16:
      return "grey 16";
    case OniPixelFormat::jpeg:
      return "JPEG of the camera";
    case OniPixelFormat::yuyv:
      return "YUYV";
  }
  return "unknown";
}

std::string to_string(OniRecordType type) {
  switch (type) {
    case OniRecordType::node_added_1004:
    case OniRecordType::node_added_1005:
    case OniRecordType::node_added:
      return "NODE_ADDED";
    case OniRecordType::int_property:
      return "INT_PROPERTY";
    case OniRecordType::real_property:
      return "REAL_PROPERTY";
    case OniRecordType::string_property:
      return "STRING_PROPERTY";
    case OniRecordType::general_property:
      return "GENERAL_PROPERTY";
    case OniRecordType::node_removed:
      return "NODE_REMOVED";
    case OniRecordType::data_begin:
      return "DATA_BEGIN";
    case OniRecordType::state_ready:
      return "STATE_READY";
    case OniRecordType::new_data:
      return "NEW_DATA";
    case OniRecordType::end:
      return "END";
    case OniRecordType::seek_table:
      return "SEEK_TABLE";
  }
  return fmt::format("record of type {}", static_cast<std::uint32_t>(type));
}

std::optional<OniPixelFormat> pixel_format_of(std::uint64_t number) {
  if ((number >= 100 && number <= 103) || (number >= 200 && number <= 205))
    return static_cast<OniPixelFormat>(number);
  return std::nullopt;
}

std::optional<OniFileHeader> parse_file_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kOniHeaderSize ||
      std::memcmp(bytes.data(), kOniFileMagic.data(), kOniFileMagic.size()) != 0)
    return std::nullopt;
  OniFileHeader header;
  header.version = {bytes[4], bytes[5], load_le<std::uint16_t>(&bytes[6]), load_le<std::uint32_t>(&bytes[8])};
  header.max_timestamp = load_le<std::uint64_t>(&bytes[12]);
  header.max_node_id = load_le<std::uint32_t>(&bytes[20]);
  return header;
}

bool is_supported(const OniVersion& version) {
  return version >= OniVersion{1, 0, 0, 4} && version <= OniVersion{1, 0, 1, 0};
}

std::string to_string(const OniVersion& version) {
  return fmt::format("{}.{}.{}.{}", version.major_part, version.minor_part, version.maintenance,
                     version.build);
}

std::optional<OniRecord> parse_record(const OniFileHeader& file, std::uint64_t position,
                                      std::span<const std::uint8_t> bytes) {
  const std::size_t header_size = file.record_header_size();
  if (bytes.size() < header_size ||
      std::memcmp(bytes.data(), kOniRecordMagic.data(), kOniRecordMagic.size()) != 0)
    return std::nullopt;
  OniRecord record;
  record.position = position;
  record.type = static_cast<OniRecordType>(load_le<std::uint32_t>(&bytes[4]));
  record.node = load_le<std::uint32_t>(&bytes[8]);
  record.fields_size = load_le<std::uint32_t>(&bytes[12]);
  record.payload_size = load_le<std::uint32_t>(&bytes[16]);
  record.undo = file.narrow() ? load_le<std::uint32_t>(&bytes[20]) : load_le<std::uint64_t>(&bytes[20]);
  if (record.fields_size < header_size) return std::nullopt;
  if (record.type == OniRecordType::new_data) {
    if (record.fields_size < header_size + kOniFrameFields || bytes.size() < header_size + kOniFrameFields)
      return std::nullopt;
    record.timestamp_us = load_le<std::uint64_t>(&bytes[header_size]);
    record.number = load_le<std::uint32_t>(&bytes[header_size + 8]);
  }
  return record;
}

std::optional<OniNodeFields> parse_node_added(const OniFileHeader& file, OniRecordType type,
                                              std::span<const std::uint8_t> fields) {
  ByteCursor cursor(fields);
  OniNodeFields node;
  const auto name = cursor.take_string(kOniMaxName);
  const auto node_type = cursor.take<std::int32_t>();
  const auto codec = cursor.take<std::uint32_t>();
  if (!name || !node_type || !codec) return std::nullopt;
  node.name = *name;
  node.type = static_cast<OniNodeType>(*node_type);
  node.codec = static_cast<OniCodec>(*codec);
  if (type == OniRecordType::node_added_1004) return node;
  const auto frames = cursor.take<std::uint32_t>();
  const auto first = cursor.take<std::uint64_t>(), last = cursor.take<std::uint64_t>();
  if (!frames || !first || !last) return std::nullopt;
  node.frames = *frames;
  node.min_timestamp_us = *first;
  node.max_timestamp_us = *last;
  if (type == OniRecordType::node_added_1005) return node;
  std::optional<std::uint64_t> table;
  if (file.narrow())
    table = cursor.take<std::uint32_t>();
  else
    table = cursor.take<std::uint64_t>();
  if (!table) return std::nullopt;
  node.table_position = *table;
  return node;
}

std::optional<OniPropertyFields> parse_property(std::span<const std::uint8_t> fields) {
  ByteCursor cursor(fields);
  const auto name = cursor.take_string(kOniMaxName);
  const auto size = cursor.take<std::uint32_t>();
  if (!name || !size) return std::nullopt;
  const auto value = cursor.take_bytes(*size);
  if (!value) return std::nullopt;
  return OniPropertyFields{*name, *value};
}

}  // namespace saccade
