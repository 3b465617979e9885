// Hundreds of damaged inputs for every parser, the same in every run.
#include <random>

#include <gtest/gtest.h>

#include "parsers.hpp"

namespace saccade {
namespace {

constexpr unsigned kMutantsPerSeed = 1000;

// Flips, cuts, repeats, removes and inserts bytes, and puts numbers and words where parsers stumble.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  Bytes mutate(Bytes bytes) {
    const unsigned rounds = 1 + below(4);
    for (unsigned i = 0; i < rounds && !bytes.empty(); ++i) change(bytes);
    return bytes;
  }

 private:
  unsigned below(std::size_t limit) { return static_cast<unsigned>(random_() % limit); }

  void change(Bytes& bytes) {
    static const std::vector<std::string_view> kWords = {"0",
                                                         "-1",
                                                         "1e999",
                                                         "nan",
                                                         "99999999999999999999",
                                                         "4294967295",
                                                         "2147483648",
                                                         "\"",
                                                         "[",
                                                         "{",
                                                         "\\u",
                                                         "\r\n",
                                                         std::string_view("\0", 1),
                                                         "\x80",
                                                         "\xff\xff\xff\xff",
                                                         "\x1b[31m",
                                                         "..",
                                                         "/",
                                                         "=",
                                                         "&",
                                                         "%d"};
    const auto at = [&](std::size_t i) { return bytes.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t from = below(bytes.size()),
                      length = 1 + below(std::min<std::size_t>(bytes.size() - from, 24));
    switch (below(6)) {
      case 0:
        bytes[from] = static_cast<std::uint8_t>(bytes[from] ^ (1U << below(8)));
        break;
      case 1:
        bytes[from] = static_cast<std::uint8_t>(below(256));
        break;
      case 2:
        bytes.resize(from);
        break;
      case 3:
        bytes.erase(at(from), at(from + length));
        break;
      case 4: {
        const Bytes copy(at(from), at(from + length));
        bytes.insert(at(below(bytes.size())), copy.begin(), copy.end());
        break;
      }
      default: {
        const std::string_view word = kWords[below(kWords.size())];
        bytes.insert(at(from), word.begin(), word.end());
      }
    }
  }

  std::mt19937 random_;
};

class Mutants : public ::testing::TestWithParam<FuzzedParser> {};

TEST_P(Mutants, AreReadOrRefused) {
  const std::vector<Bytes> seeds = GetParam().seeds();
  ASSERT_FALSE(seeds.empty());
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    EXPECT_TRUE(GetParam().read(seeds[s])) << "seed " << s;
    unsigned refused = 0;
    for (unsigned k = 0; k < kMutantsPerSeed; ++k) {
      const unsigned number = kMutantsPerSeed * static_cast<unsigned>(s) + k;
      const Bytes mutant = Mutator(number).mutate(seeds[s]);
      try {
        refused += GetParam().read(mutant) ? 0 : 1;
      } catch (const std::exception& fault) {
        FAIL() << "mutant " << number << ": " << fault.what();
      }
    }
    EXPECT_GT(refused, 0U) << "seed " << s;
  }
}

INSTANTIATE_TEST_SUITE_P(Parsers, Mutants,
                         ::testing::ValuesIn(fuzzed_parsers().begin(), fuzzed_parsers().end()),
                         [](const auto& parser) { return std::string(parser.param.name); });

}  // namespace
}  // namespace saccade
