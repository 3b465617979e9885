#include "sources/chunk_cache.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saccade {
namespace {

using ::testing::ElementsAre;

// Chunk n holds n twice; those from 100 on are damaged. Remembers what was loaded.
class Chunks {
 public:
  std::vector<std::uint8_t> get(std::uint64_t number) {
    const auto bytes = cache_.get(number, [this](std::uint64_t n, std::vector<std::uint8_t>& out) {
      loaded.push_back(n);
      out.assign(1, 0xFF);
      if (n >= 100) throw std::runtime_error("damaged");
      out.assign(2, static_cast<std::uint8_t>(n));
    });
    return {bytes.begin(), bytes.end()};
  }

  std::vector<std::uint64_t> loaded;

 private:
  ChunkCache cache_;
};

TEST(ChunkCache, TheLastTwoAreLoadedOnce) {
  Chunks chunks;
  for (const int n : {1, 2, 1, 2, 3, 2, 1}) EXPECT_THAT(chunks.get(n), ElementsAre(n, n));
  EXPECT_THAT(chunks.loaded, ElementsAre(1, 2, 3, 1));
}

TEST(ChunkCache, ADamagedOneLeavesNothingInThePlaceOfAnother) {
  Chunks chunks;
  chunks.get(1);
  chunks.get(2);
  EXPECT_THROW(chunks.get(100), std::runtime_error);
  EXPECT_THAT(chunks.get(1), ElementsAre(1, 1));
  EXPECT_THAT(chunks.get(2), ElementsAre(2, 2));
  EXPECT_THROW(chunks.get(100), std::runtime_error) << "it is not taken for loaded";
}

}  // namespace
}  // namespace saccade
