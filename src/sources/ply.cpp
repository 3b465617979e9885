#include "sources/ply.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/image_size.hpp"
#include "sources/cloud_values.hpp"

namespace saccade {
namespace {

using Bytes = std::span<const std::uint8_t>;
using std::string_view;

std::runtime_error broken_ply(const std::string& why) {
  return std::runtime_error("not a sound PLY: " + why);
}

struct Coordinate {
  std::size_t offset = 0, size = 0;  // bytes; size 0 = absent
};

struct PlyHeader {
  cv::Size size;
  std::optional<Intrinsics> camera;
  std::size_t vertices = 0, vertex_bytes = 0, data_begin = 0;
  std::array<Coordinate, 3> xyz;
  std::array<std::optional<std::size_t>, 3> bgr;  // positions of bytes
  bool has_colour() const { return bgr[0] && bgr[1] && bgr[2]; }
  bool binary = false, in_vertex = false, has_vertex = false;
};

template <typename Number>
Number parse(string_view word) {
  Number value{};
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc{} || end != word.data() + word.size())
    throw broken_ply(fmt::format("'{}' is no number", word.substr(0, 20)));
  return value;
}

std::size_t bytes_of_type(string_view type) {
  constexpr std::array<std::pair<string_view, std::size_t>, 16> kTypes = {{{"char", 1},
                                                                           {"uchar", 1},
                                                                           {"int8", 1},
                                                                           {"uint8", 1},
                                                                           {"short", 2},
                                                                           {"ushort", 2},
                                                                           {"int16", 2},
                                                                           {"uint16", 2},
                                                                           {"int", 4},
                                                                           {"uint", 4},
                                                                           {"int32", 4},
                                                                           {"uint32", 4},
                                                                           {"float", 4},
                                                                           {"float32", 4},
                                                                           {"double", 8},
                                                                           {"float64", 8}}};
  for (const auto& [name, bytes] : kTypes)
    if (name == type) return bytes;
  throw broken_ply("a property of an unknown type");
}

void read_property(PlyHeader& header, const std::vector<string_view>& words) {
  constexpr std::size_t kLargestVertex = 4096;
  if (!header.in_vertex) return;  // of an element after the vertices, which is not read
  if (words.size() != 3) throw broken_ply("a vertex has a list");
  const std::size_t bytes = bytes_of_type(words[1]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (words[2] == string_view(&"xyz"[axis], 1)) {
      if (!words[1].starts_with("float") && !words[1].starts_with("double"))
        throw broken_ply("x, y and z must be floats");
      header.xyz[axis] = {header.vertex_bytes, bytes};
    }
  constexpr std::array<string_view, 3> kBgr = {"blue", "green", "red"};
  for (std::size_t channel = 0; channel < 3; ++channel)
    if (words[2] == kBgr[channel] && (words[1] == "uchar" || words[1] == "uint8"))
      header.bgr[channel] = header.vertex_bytes;
  header.vertex_bytes += bytes;
  if (header.vertex_bytes > kLargestVertex) throw broken_ply("a vertex is too large");
}

void read_line(PlyHeader& header, const std::vector<string_view>& words) {
  if (words[0] == "format" && words.size() > 1) header.binary = words[1] == "binary_little_endian";
  if (words[0] == "property") read_property(header, words);
  if (words[0] == "element") {
    if (words.size() != 3) throw broken_ply("an element without its number");
    header.in_vertex = words[1] == "vertex";
    if (!header.in_vertex && !header.has_vertex) throw broken_ply("vertices are not its first element");
    if (header.in_vertex) header.vertices = parse<std::size_t>(words[2]);
    header.has_vertex = true;
  }
  if (words[0] != "obj_info" || words.size() < 3) return;
  if (words[1] == "num_cols") header.size.width = parse<int>(words[2]);
  if (words[1] == "num_rows") header.size.height = parse<int>(words[2]);
  if (words[1] == "camera" && words.size() == 6) {
    header.camera = Intrinsics{parse<double>(words[2]), parse<double>(words[3]), parse<double>(words[4]),
                               parse<double>(words[5]), IntrinsicsOrigin::file};
  }
}

void check(const PlyHeader& header) {
  const auto [width, height] = header.size;
  if (width <= 0 || height <= 0 || !header.camera || !header.camera->valid())
    throw std::runtime_error("the PLY names neither image nor camera (obj_info num_cols, num_rows, camera)");
  check_image_size(width, height);
  if (!header.binary) throw std::runtime_error("the PLY is not binary_little_endian");
  for (const Coordinate& coordinate : header.xyz)
    if (coordinate.size == 0) throw broken_ply("a vertex has no x, y and z");
  if (header.vertices > static_cast<std::size_t>(header.size.area()))
    throw broken_ply("it has more points than the image has pixels");
}

PlyHeader read_ply_header(Bytes ply) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  const string_view text(reinterpret_cast<const char*>(ply.data()), std::min(ply.size(), kLongestHeader));
  if (!text.starts_with("ply")) throw broken_ply("it does not begin with ply");
  PlyHeader header;
  for (std::size_t begin = 0; header.data_begin == 0;) {
    const std::size_t end = text.find('\n', begin);
    if (end == string_view::npos) throw broken_ply("its header has no end");
    const auto words = words_of(text.substr(begin, end - begin));
    begin = end + 1;
    if (words.empty()) continue;
    if (words[0] == "end_header")
      header.data_begin = begin;
    else
      read_line(header, words);
  }
  check(header);
  return header;
}

double value(const std::uint8_t* vertex, const Coordinate& coordinate) {
  return float_at(vertex + coordinate.offset, coordinate.size);
}

}  // namespace

cv::Size read_ply_size(Bytes ply) { return read_ply_header(ply).size; }

OrganisedCloud read_ply(Bytes ply) {
  const PlyHeader header = read_ply_header(ply);
  const Bytes data = ply.subspan(header.data_begin);
  if (data.size() / std::max<std::size_t>(header.vertex_bytes, 1) < header.vertices)
    throw broken_ply("the file is cut");
  const Intrinsics& camera = header.camera.value();
  OrganisedCloud cloud{cv::Mat1f(header.size, 0.0F), {}, camera};
  if (header.has_colour()) cloud.colour = cv::Mat3b(header.size, cv::Vec3b(0, 0, 0));
  for (std::size_t i = 0; i < header.vertices; ++i) {
    const std::uint8_t* vertex = data.data() + i * header.vertex_bytes;
    const double x = value(vertex, header.xyz[0]), y = value(vertex, header.xyz[1]),
                 z = value(vertex, header.xyz[2]);
    if (!(z > 0) || !std::isfinite(z)) continue;
    const double col = std::round(x / z * camera.fx + camera.cx);
    const double row = std::round(y / z * camera.fy + camera.cy);
    if (!(col >= 0 && col < header.size.width && row >= 0 && row < header.size.height))
      throw broken_ply("a point is outside of its image");
    const cv::Point pixel(static_cast<int>(col), static_cast<int>(row));
    cloud.depth_mm(pixel) = static_cast<float>(z);
    if (header.has_colour())
      cloud.colour(pixel) = {vertex[*header.bgr[0]], vertex[*header.bgr[1]], vertex[*header.bgr[2]]};
  }
  return cloud;
}

}  // namespace saccade
