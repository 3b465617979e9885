#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>

namespace saccade {

/// The checksums (CRC-32) of a Matroska file's clusters, which ffmpeg writes and its reader ignores. Nothing
/// in the file can make it throw: what cannot be parsed counts as a file without checksums.
class MatroskaChecksums {
 public:
  explicit MatroskaChecksums(const std::filesystem::path& path);

  /// Whether the checksum of the cluster around this byte of the file does not fit, or there is no checksum
  /// though the first cluster has one. Reads the file from the last call's position on, so that `position`
  /// must not decrease.
  [[nodiscard]] bool damaged_at(std::int64_t position);

  /// The number of damaged clusters up to the last call's position.
  std::int64_t damaged_clusters() const { return damaged_clusters_; }

  /// Whether the first cluster has a checksum.
  bool present() const { return present_; }

 private:
  struct Element {
    std::uint32_t id = 0;
    std::int64_t content = 0, size = 0;  // position and bytes; size -1 = unknown
    std::int64_t end() const { return content + size; }
  };

  std::size_t read(std::int64_t position, std::span<std::uint8_t> bytes);
  std::optional<Element> element_at(std::int64_t position);
  std::optional<std::uint32_t> checksum_of(const Element& cluster, std::int64_t& begin);
  std::uint32_t compute(std::int64_t begin, std::int64_t end);
  bool next_cluster();

  std::ifstream file_;
  std::int64_t size_ = 0, next_ = 0;  // next_: the element of the segment after the present cluster
  Element cluster_;                   // the present one; end() 0 before the first
  bool damaged_ = false, present_ = false;
  std::int64_t damaged_clusters_ = 0;
};

}  // namespace saccade
