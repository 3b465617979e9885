#include "core/huffman_code.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace saccade {
namespace {

constexpr int kLongest = 15;
using LengthCounts = std::array<std::uint32_t, kLongest + 1>;  // of symbols, by the length of their codes

// The lengths of Huffman's codes for `weights`, which are in rising order. Two queues hold the nodes that
// have no parent yet: the symbols, and the inner nodes, whose weights rise as they are made.
std::vector<int> tree_depths(const std::vector<std::uint32_t>& weights) {
  const std::size_t leaves = weights.size(), nodes = 2 * leaves - 1;
  std::vector<std::uint32_t> weight(weights);
  weight.resize(nodes);
  std::vector<std::size_t> parent(nodes);
  std::size_t leaf = 0, inner = leaves;
  for (std::size_t made = leaves; made < nodes; ++made)
    for (int child = 0; child < 2; ++child) {
      const bool takes_leaf = leaf < leaves && (inner == made || weight[leaf] <= weight[inner]);
      const std::size_t taken = takes_leaf ? leaf++ : inner++;
      parent[taken] = made;
      weight[made] += weight[taken];
    }
  std::vector<int> depth(nodes, 0);  // the last node is the root
  for (std::size_t i = nodes - 1; i-- > 0;) depth[i] = depth[parent[i]] + 1;
  depth.resize(leaves);
  return depth;
}

// How many codes of each length there are, after codes beyond the limit have been cut to it. The sum of
// 2^-length over all codes must be 1 (Kraft): cut codes add to it, and longer codes for others make up.
LengthCounts limited_lengths(const std::vector<int>& depths, int limit) {
  LengthCounts counts{};
  const auto at = [&](int length) -> std::uint32_t& { return counts[static_cast<std::size_t>(length)]; };
  std::uint32_t sum = 0;  // in units of 2^-limit
  for (const int depth : depths) {
    const int length = std::min(depth, limit);
    ++at(length);
    sum += 1U << (limit - length);
  }
  for (const std::uint32_t all = 1U << limit; sum > all; --sum) {
    // One code of the limit moves up to share the place of a shorter one, which becomes a bit longer.
    int shorter = limit - 1;
    while (at(shorter) == 0) --shorter;
    --at(shorter);
    at(shorter + 1) += 2;
    --at(limit);
  }
  return counts;
}

std::uint16_t reversed(unsigned code, int length) {
  unsigned result = 0;
  for (int i = 0; i < length; ++i) result |= (code >> i & 1U) << (length - 1 - i);
  return static_cast<std::uint16_t>(result);
}

// Codes of the same length count upwards in the order of the symbols (RFC 1951, 3.2.2).
void set_codes(const LengthCounts& counts, HuffmanCode& code) {
  std::array<unsigned, kLongest + 1> next{};
  for (std::size_t length = 1; length < next.size(); ++length)
    next[length] = (next[length - 1] + counts[length - 1]) << 1;
  for (std::size_t i = 0; i < code.lengths.size(); ++i)
    if (const int length = code.lengths[i]; length > 0)
      code.codes[i] = reversed(next[static_cast<std::size_t>(length)]++, length);
}

}  // namespace

HuffmanCode make_huffman_code(std::span<const std::uint32_t> counts, int limit) {
  std::vector<std::size_t> symbols;  // the rarest first
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) symbols.push_back(i);
  std::ranges::stable_sort(symbols, {}, [&](std::size_t i) { return counts[i]; });
  std::vector<std::uint32_t> weights;
  weights.reserve(symbols.size());
  for (const std::size_t i : symbols) weights.push_back(counts[i]);
  const LengthCounts lengths = limited_lengths(tree_depths(weights), limit);

  HuffmanCode code{std::vector<std::uint8_t>(counts.size()), std::vector<std::uint16_t>(counts.size())};
  auto symbol = symbols.begin();
  for (int length = limit; length > 0; --length)
    for (std::uint32_t i = 0; i < lengths[static_cast<std::size_t>(length)]; ++i)
      code.lengths[*symbol++] = static_cast<std::uint8_t>(length);
  set_codes(lengths, code);
  return code;
}

}  // namespace saccade
