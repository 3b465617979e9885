#include "matroska_writer.hpp"

#include <bit>
#include <string_view>

#include "core/file.hpp"

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

void add(Bytes& to, const Bytes& from) { to.insert(to.end(), from.begin(), from.end()); }

Bytes big_endian(std::uint64_t value, int bytes) {
  Bytes out;
  for (int i = bytes - 1; i >= 0; --i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return out;
}

Bytes little_endian(std::uint64_t value, int bytes) {
  const Bytes big = big_endian(value, bytes);
  return {big.rbegin(), big.rend()};
}

// An EBML element: the id as it is written, the size in eight bytes, the content.
Bytes element(std::uint32_t id, const Bytes& content) {
  Bytes out = big_endian(id, (static_cast<int>(std::bit_width(id)) + 7) / 8);
  add(out, big_endian(0x0100000000000000U | content.size(), 8));
  add(out, content);
  return out;
}

Bytes number(std::uint32_t id, std::uint64_t value) { return element(id, big_endian(value, 8)); }
Bytes text(std::uint32_t id, std::string_view value) { return element(id, {value.begin(), value.end()}); }

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes out;
  for (const Bytes& part : parts) add(out, part);
  return out;
}

void write(const std::filesystem::path& path, const Bytes& codec, const Bytes& colour_space, cv::Size size,
           int period_ms, const std::vector<Bytes>& packets) {
  const Bytes video = joined({number(0xB0, static_cast<std::uint64_t>(size.width)),
                              number(0xBA, static_cast<std::uint64_t>(size.height)), colour_space});
  const Bytes track =
      joined({number(0xD7, 1), number(0x73C5, 1), number(0x83, 1), codec,
              number(0x23E383, 1'000'000U * static_cast<std::uint64_t>(period_ms)), element(0xE0, video)});
  Bytes clusters;
  for (std::size_t k = 0; k < packets.size(); ++k) {
    Bytes block = {0x81, 0, 0, 0x80};  // track 1, at the cluster's time, a key frame
    add(block, packets[k]);
    add(clusters, element(0x1F43B675, joined({number(0xE7, k * static_cast<std::uint64_t>(period_ms)),
                                              element(0xA3, block)})));
  }
  const Bytes info = joined({number(0x2AD7B1, 1'000'000), text(0x4D80, "saccade"), text(0x5741, "saccade")});
  const Bytes file = joined(
      {element(0x1A45DFA3, joined({text(0x4282, "matroska"), number(0x4287, 4), number(0x4285, 2)})),
       element(0x18538067,
               joined({element(0x1549A966, info), element(0x1654AE6B, element(0xAE, track)), clusters}))});
  write_file(path, file);
}

}  // namespace

void write_matroska(const std::filesystem::path& path, std::uint32_t fourcc, cv::Size size, int bits,
                    int period_ms, const std::vector<Bytes>& packets) {
  const Bytes header =
      joined({little_endian(40, 4), little_endian(static_cast<std::uint64_t>(size.width), 4),
              little_endian(static_cast<std::uint64_t>(size.height), 4), little_endian(1, 2),
              little_endian(static_cast<std::uint64_t>(bits), 2), little_endian(fourcc, 4), Bytes(20)});
  write(path, joined({text(0x86, "V_MS/VFW/FOURCC"), element(0x63A2, header)}), {}, size, period_ms, packets);
}

void write_raw_matroska(const std::filesystem::path& path, cv::Size size, int period_ms,
                        const std::vector<Bytes>& packets) {
  write(path, text(0x86, "V_UNCOMPRESSED"), element(0x2EB524, {'Y', '1', 0, 16}), size, period_ms, packets);
}

}  // namespace saccade
