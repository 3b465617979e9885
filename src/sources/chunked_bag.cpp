#include "sources/chunked_bag.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace saccade {

void ChunkedBag::scan(const Visit& visit) {
  std::uint64_t position = begin_;
  try {
    while (scan_record(position, visit)) {
    }
  } catch (const std::runtime_error& error) {
    problems_.push_back(fmt::format("at byte {}: {}", position, error.what()));
  }
}

ChunkedBag::Bytes ChunkedBag::read(const BagPlace& place) {
  if (place.part == 0) {
    message_.resize(place.size);
    if (file_.read(place.offset, message_) != place.size) throw std::runtime_error("the file is cut");
    return message_;
  }
  const Bytes chunk = chunk_at(place.part);
  if (place.offset + place.size > chunk.size()) throw std::runtime_error("the chunk is too short");
  return chunk.subspan(place.offset, place.size);
}

void ChunkedBag::scan_chunk(std::uint64_t position, const Visit& visit) {
  try {
    scan_records(position, chunk_at(position), visit);
  } catch (const std::runtime_error& error) {
    problems_.push_back(fmt::format("messages of the chunk at byte {} are lost: {}", position, error.what()));
  }
}

void ChunkedBag::fill(std::uint64_t position, std::uint64_t size, std::vector<std::uint8_t>& bytes) const {
  bytes.resize(size);
  if (file_.read(position, bytes) != size) throw std::runtime_error("the file cannot be read");
}

ChunkedBag::Bytes ChunkedBag::chunk_at(std::uint64_t position) {
  return chunks_.get(position, [this](std::uint64_t at, auto& bytes) { load_chunk(at, bytes); });
}

}  // namespace saccade
