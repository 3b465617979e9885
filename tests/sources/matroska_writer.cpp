#include "matroska_writer.hpp"

#include <bit>
#include <map>
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

Bytes fourcc_codec(std::uint32_t fourcc, cv::Size size, int bits) {
  const Bytes header =
      joined({little_endian(40, 4), little_endian(static_cast<std::uint64_t>(size.width), 4),
              little_endian(static_cast<std::uint64_t>(size.height), 4), little_endian(1, 2),
              little_endian(static_cast<std::uint64_t>(bits), 2), little_endian(fourcc, 4), Bytes(20)});
  return joined({text(0x86, "V_MS/VFW/FOURCC"), element(0x63A2, header)});
}

Bytes track(std::uint64_t index, const Bytes& codec, const Bytes& colour_space, cv::Size size,
            int period_ms) {
  const Bytes video = joined({number(0xB0, static_cast<std::uint64_t>(size.width)),
                              number(0xBA, static_cast<std::uint64_t>(size.height)), colour_space});
  return joined({number(0xD7, index), number(0x73C5, index), number(0x83, 1), codec,
                 number(0x23E383, 1'000'000U * static_cast<std::uint64_t>(period_ms)), element(0xE0, video)});
}

// A packet as a block of a cluster, a key frame; `time` counts from that of the cluster.
Bytes block(std::uint8_t track, std::int16_t time, const Bytes& packet) {
  Bytes content = {static_cast<std::uint8_t>(0x80U | track)};
  add(content, big_endian(static_cast<std::uint16_t>(time), 2));
  content.push_back(0x80);
  add(content, packet);
  return element(0xA3, content);
}

Bytes cluster(std::uint64_t time, const Bytes& blocks) {
  return element(0x1F43B675, joined({number(0xE7, time), blocks}));
}

// `tracks`: TrackEntry elements; `rest`: what follows them.
void write(const std::filesystem::path& path, const Bytes& tracks, const Bytes& rest,
           std::uint64_t time_unit_ns) {
  const Bytes info =
      joined({number(0x2AD7B1, time_unit_ns), text(0x4D80, "saccade"), text(0x5741, "saccade")});
  write_file(
      path,
      joined({element(0x1A45DFA3, joined({text(0x4282, "matroska"), number(0x4287, 4), number(0x4285, 2)})),
              element(0x18538067, joined({element(0x1549A966, info), element(0x1654AE6B, tracks), rest}))}));
}

void write_one_track(const std::filesystem::path& path, const Bytes& codec, const Bytes& colour_space,
                     cv::Size size, int period_ms, const std::vector<Bytes>& packets) {
  Bytes clusters;
  for (std::size_t k = 0; k < packets.size(); ++k)
    add(clusters, cluster(k * static_cast<std::uint64_t>(period_ms), block(1, 0, packets[k])));
  write(path, element(0xAE, track(1, codec, colour_space, size, period_ms)), clusters, 1'000'000);
}

}  // namespace

void write_matroska(const std::filesystem::path& path, std::uint32_t fourcc, cv::Size size, int bits,
                    int period_ms, const std::vector<Bytes>& packets) {
  write_one_track(path, fourcc_codec(fourcc, size, bits), {}, size, period_ms, packets);
}

void write_raw_matroska(const std::filesystem::path& path, cv::Size size, int period_ms,
                        const std::vector<Bytes>& packets) {
  write_one_track(path, text(0x86, "V_UNCOMPRESSED"), element(0x2EB524, {'Y', '1', 0, 16}), size, period_ms,
                  packets);
}

void write_matroska(const std::filesystem::path& path, const std::vector<MatroskaTrack>& tracks,
                    const std::vector<MatroskaAttachment>& attachments) {
  constexpr std::uint64_t kUnit_ns = 1000;
  constexpr std::int64_t kLongest_us = 32'000;  // of a cluster: blocks have 16 bits for their times
  struct Packet {
    std::uint8_t track = 0;
    const Bytes* content = nullptr;
  };
  Bytes entries, files, rest;
  std::multimap<std::int64_t, Packet> packets;  // by time, us
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const MatroskaTrack& one = tracks[i];
    const Bytes kind = one.size.empty() ? joined({number(0xD7, i + 1), number(0x73C5, i + 1),
                                                  number(0x83, 0x11), text(0x86, "S_K4A/IMU")})
                                        : track(i + 1, fourcc_codec(one.fourcc, one.size, one.bits), {},
                                                one.size, one.period_ms);
    add(entries, element(0xAE, joined({kind, text(0x536E, one.title)})));
    std::int64_t time_us = std::int64_t{1000} * one.start_ms;
    for (const Bytes& packet : one.packets) {
      packets.emplace(time_us, Packet{static_cast<std::uint8_t>(i + 1), &packet});
      time_us += std::int64_t{1000} * one.period_ms;
    }
  }
  for (std::size_t i = 0; i < attachments.size(); ++i)
    add(files,
        element(0x61A7, joined({text(0x466E, attachments[i].name), text(0x4660, "application/octet-stream"),
                                number(0x46AE, i + 1), text(0x465C, attachments[i].content)})));
  if (!files.empty()) rest = element(0x1941A469, files);
  add(rest, element(0xEC, Bytes(500)));  // room that the recorder leaves
  for (auto packet = packets.begin(); packet != packets.end();) {
    const std::int64_t begin_us = packet->first;
    Bytes blocks;
    for (; packet != packets.end() && packet->first - begin_us <= kLongest_us; ++packet)
      add(blocks, block(packet->second.track, static_cast<std::int16_t>(packet->first - begin_us),
                        *packet->second.content));
    add(rest, cluster(static_cast<std::uint64_t>(begin_us), blocks));
  }
  write(path, entries, rest, kUnit_ns);
}

}  // namespace saccade
