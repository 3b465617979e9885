#include "sources/pcd.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/image_size.hpp"
#include "oni/bytes.hpp"
#include "sources/cloud_camera.hpp"
#include "sources/cloud_values.hpp"
#include "sources/lzf.hpp"

namespace saccade {
namespace {

using Bytes = std::span<const std::uint8_t>;
using std::string_view;

constexpr std::size_t kMostFields = 64, kLargestPoint = 4096;  // more is no camera's cloud

struct Field {
  std::size_t size = 4, count = 1;
  char type = 'F';
  std::string name;
  std::size_t offset = 0;  // in a point, bytes
};

struct PcdHeader {
  std::vector<Field> fields;
  cv::Size size;
  std::size_t point_bytes = 0, points = 0;
  std::string encoding;
  std::size_t data_begin = 0;
  std::array<std::size_t, 3> xyz{};  // indices of the fields
  std::optional<std::size_t> rgb;    // likewise
};

std::runtime_error broken_pcd(const std::string& why) {
  return std::runtime_error("not a sound PCD: " + why);
}

std::size_t parse_integer(string_view word, std::size_t most, const char* what) {
  std::size_t value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc{} || end != word.data() + word.size() || value > most)
    throw broken_pcd(fmt::format("{} is not an integer up to {}", what, most));
  return value;
}

// Calls set(field, word) for each field with its word of a header line.
template <typename Set>
void for_each_field(PcdHeader& header, const std::vector<string_view>& words, Set set) {
  if (words.size() - 1 != header.fields.size())
    throw broken_pcd(fmt::format("{} is not given for each field", words[0]));
  for (std::size_t i = 1; i < words.size(); ++i) set(header.fields[i - 1], words[i]);
}

void read_line(PcdHeader& header, const std::vector<string_view>& words) {
  constexpr std::array<string_view, 11> kKeys = {"VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
                                                 "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  const string_view key = words[0];
  if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
    throw broken_pcd("its header has an unknown line");
  if (words.size() < 2) throw broken_pcd(fmt::format("nothing follows {}", key));
  const auto side = [&](const char* what) {
    return static_cast<int>(parse_integer(words[1], 1u << 30, what));
  };
  if (key == "FIELDS" || key == "COLUMNS") {
    if (words.size() - 1 > kMostFields) throw broken_pcd("too many fields");
    header.fields.resize(words.size() - 1);
    for_each_field(header, words, [](Field& field, string_view word) { field.name = word; });
  } else if (key == "SIZE") {
    for_each_field(header, words,
                   [](Field& field, string_view word) { field.size = parse_integer(word, 8, "SIZE"); });
  } else if (key == "TYPE") {
    for_each_field(header, words, [](Field& field, string_view word) { field.type = word[0]; });
  } else if (key == "COUNT") {
    for_each_field(header, words, [](Field& field, string_view word) {
      field.count = parse_integer(word, kLargestPoint, "COUNT");
    });
  } else if (key == "WIDTH") {
    header.size.width = side("WIDTH");
  } else if (key == "HEIGHT") {
    header.size.height = side("HEIGHT");
  } else if (key == "POINTS") {
    header.points = parse_integer(words[1], std::size_t{1} << 40, "POINTS");
  } else if (key == "DATA") {
    header.encoding = words[1];
  }  // VERSION and VIEWPOINT do not matter
}

void check_header(PcdHeader& header) {
  const auto [width, height] = header.size;
  if (width <= 0 || height <= 0) throw broken_pcd("no WIDTH or HEIGHT");
  if (height == 1) throw std::runtime_error("the cloud is not organised: HEIGHT is 1");
  check_image_size(width, height);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (header.points != 0 && header.points != pixels) throw broken_pcd("POINTS is not WIDTH times HEIGHT");
  header.points = pixels;
  for (Field& field : header.fields) {
    field.offset = header.point_bytes;
    header.point_bytes += field.size * field.count;
    if (header.point_bytes > kLargestPoint) throw broken_pcd("a point is too large");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto field = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const Field& f) { return f.name == name; });
    if (field == header.fields.end()) throw broken_pcd("no field " + name);
    if (field->type != 'F' || field->count != 1 || (field->size != 4 && field->size != 8))
      throw broken_pcd(fmt::format("field {} is not one float of 4 or 8 bytes", name));
    header.xyz[axis] = static_cast<std::size_t>(field - header.fields.begin());
  }
  const auto is_colour = [](const Field& f) {
    return (f.name == "rgb" || f.name == "rgba") && f.size == 4 && f.count == 1;
  };
  const auto colour = std::ranges::find_if(header.fields, is_colour);
  if (colour != header.fields.end()) header.rgb = static_cast<std::size_t>(colour - header.fields.begin());
}

string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

PcdHeader read_pcd_header(Bytes pcd) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  const string_view text = text_of(pcd.first(std::min(pcd.size(), kLongestHeader)));
  PcdHeader header;
  std::size_t begin = 0;
  while (header.encoding.empty()) {
    const std::size_t end = text.find('\n', begin);
    if (end == string_view::npos) throw broken_pcd("its header has no DATA line");
    const auto words = words_of(text.substr(begin, end - begin));
    begin = end + 1;
    if (!words.empty() && words[0][0] != '#') read_line(header, words);
  }
  header.data_begin = begin;
  check_header(header);
  return header;
}

struct Points {
  std::vector<cv::Point3d> places;
  std::vector<cv::Vec3b> colours;  // BGR; empty = none

  explicit Points(const PcdHeader& header) : places(header.points), colours(header.rgb ? header.points : 0) {}
};

cv::Vec3b colour_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb >> 16)};
}

// The data have the fields of one point side by side, or (by_field) all values of one field side by side.
Points read_binary(const PcdHeader& header, Bytes data, bool by_field) {
  if (data.size() < header.points * header.point_bytes) throw broken_pcd("the file is cut");
  Points points(header);
  const auto value_of = [&](const Field& field, std::size_t point) {
    return data.data() + (by_field ? field.offset * header.points + point * field.size
                                   : point * header.point_bytes + field.offset);
  };
  for (std::size_t i = 0; i < points.places.size(); ++i) {
    const auto coordinate = [&](std::size_t axis) {
      const Field& field = header.fields[header.xyz[axis]];
      return float_at(value_of(field, i), field.size);
    };
    points.places[i] = {coordinate(0), coordinate(1), coordinate(2)};
    if (header.rgb)
      points.colours[i] = colour_of(load_le<std::uint32_t>(value_of(header.fields[*header.rgb], i)));
  }
  return points;
}

Points read_compressed(const PcdHeader& header, Bytes data) {
  std::array<std::uint32_t, 2> sizes{};  // compressed, uncompressed; little-endian
  if (data.size() < sizeof(sizes)) throw broken_pcd("the file is cut");
  std::memcpy(sizes.data(), data.data(), sizeof(sizes));
  if (sizes[1] != header.points * header.point_bytes)
    throw broken_pcd("its uncompressed size is not that of its points");
  if (sizes[0] > data.size() - sizeof(sizes)) throw broken_pcd("the file is cut");
  // LZF makes at most 264 bytes of 3; data that claim more are not decompressed.
  if (sizes[1] / 88 > sizes[0]) throw broken_pcd("its compressed data are too short");
  std::vector<std::uint8_t> plain(sizes[1]);
  if (!lzf_decompress(data.subspan(sizeof(sizes), sizes[0]), plain))
    throw broken_pcd("its compressed data are damaged");
  return read_binary(header, plain, true);
}

double parse_coordinate(string_view word) {
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code == std::errc::result_out_of_range) return std::nan("");
  if (code != std::errc{} || end != word.data() + word.size()) throw broken_pcd("a value is no number");
  return value;
}

// The colour of a word: an integer, or (TYPE F) a float with the bits of one.
std::uint32_t parse_rgb(const Field& field, string_view word) {
  const double value = parse_coordinate(word);
  if (field.type == 'F') return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return value >= 0 && value < 0x1p32 ? static_cast<std::uint32_t>(value) : 0;
}

Points read_ascii(const PcdHeader& header, string_view text) {
  std::vector<std::size_t> columns;  // of the fields
  std::size_t next = 0;
  for (const Field& field : header.fields) {
    columns.push_back(next);
    next += field.count;
  }
  const std::array<std::size_t, 3> xyz = {columns[header.xyz[0]], columns[header.xyz[1]],
                                          columns[header.xyz[2]]};
  std::size_t last = std::ranges::max(xyz);
  if (header.rgb) last = std::max(last, columns[*header.rgb]);
  if (text.size() / 2 < header.points)
    throw broken_pcd("the file is cut");  // before memory is allocated for it
  Points points(header);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < points.places.size(); ++i) {
    std::vector<string_view> words;
    while (words.empty()) {  // blank lines do not count
      if (begin >= text.size()) throw broken_pcd("the file is cut");
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      words = words_of(text.substr(begin, end - begin));
      begin = end + 1;
    }
    if (words.size() <= last) throw broken_pcd("a line has too few numbers");
    points.places[i] = {parse_coordinate(words[xyz[0]]), parse_coordinate(words[xyz[1]]),
                        parse_coordinate(words[xyz[2]])};
    if (header.rgb)
      points.colours[i] = colour_of(parse_rgb(header.fields[*header.rgb], words[columns[*header.rgb]]));
  }
  return points;
}

Points read_points(const PcdHeader& header, Bytes data) {
  if (header.encoding == "ascii") return read_ascii(header, text_of(data));
  if (header.encoding == "binary") return read_binary(header, data, false);
  if (header.encoding == "binary_compressed") return read_compressed(header, data);
  throw broken_pcd("its DATA is not ascii, binary or binary_compressed");
}

}  // namespace

cv::Size read_pcd_size(Bytes pcd) { return read_pcd_header(pcd).size; }

OrganisedCloud read_pcd(Bytes pcd) {
  const PcdHeader header = read_pcd_header(pcd);
  const Points points = read_points(header, pcd.subspan(header.data_begin));
  OrganisedCloud cloud{cv::Mat1f(header.size), {}, fit_camera(points.places, header.size)};
  std::ranges::transform(points.places, cloud.depth_mm.begin(), [](const cv::Point3d& p) {
    return is_seen(p) ? static_cast<float>(p.z * 1000) : 0.0F;
  });
  if (points.colours.empty()) return cloud;
  cloud.colour.create(header.size);
  std::ranges::copy(points.colours, cloud.colour.begin());
  return cloud;
}

}  // namespace saccade
