#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "oni/input_file.hpp"
#include "sources/bag_file.hpp"
#include "sources/chunk_cache.hpp"

namespace saccade {

/// What recordings of records have in common whose messages are within chunks or beside them. In a BagPlace,
/// part 0 is the file itself, and any other the position of a chunk.
class ChunkedBag : public BagFile {
 public:
  void scan(const Visit& visit) final;
  const std::vector<BagTopic>& topics() const final { return topics_; }
  const std::vector<std::string>& problems() const final { return problems_; }
  Bytes read(const BagPlace& place) final;

 protected:
  /// `begin`: position of the first record.
  ChunkedBag(const std::filesystem::path& path, std::uint64_t begin) : file_(path), begin_(begin) {}

  // Of each format; they throw std::runtime_error with the reason.
  /// Reads the record at `position` and moves on; false at the end of the data.
  virtual bool scan_record(std::uint64_t& position, const Visit& visit) = 0;
  /// Reads the records of the chunk at `position`.
  virtual void scan_records(std::uint64_t position, Bytes chunk, const Visit& visit) = 0;
  /// Decompresses the chunk at `position`.
  virtual void load_chunk(std::uint64_t position, std::vector<std::uint8_t>& bytes) = 0;

  /// A damaged chunk costs its messages only.
  void scan_chunk(std::uint64_t position, const Visit& visit);
  /// `size` bytes of the file, into `bytes`. Throws std::runtime_error if they are not there.
  void fill(std::uint64_t position, std::uint64_t size, std::vector<std::uint8_t>& bytes) const;

  InputFile file_;
  std::vector<BagTopic> topics_;
  std::vector<std::uint8_t> message_;

 private:
  Bytes chunk_at(std::uint64_t position);

  std::uint64_t begin_;
  std::vector<std::string> problems_;
  ChunkCache chunks_;
};

}  // namespace saccade
