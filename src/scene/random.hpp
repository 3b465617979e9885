#pragma once

#include <cstdint>

namespace saccade::scene {

/// A counter turned into 64 well-mixed bits (the finaliser of SplitMix64). Integer arithmetic only, so a
/// number depends on its counter alone: not on the order of calls, the machine or the standard library.
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Combines two keys, for nested streams: the seed with the frame, the result with the row.
constexpr std::uint64_t mix(std::uint64_t a, std::uint64_t b) { return mix(mix(a) ^ b); }

/// Uniform in [0, 1) from the upper 53 bits.
constexpr double uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// Nearly normal, mean 0 and variance 1, from the lower 48 bits: the sum of four uniform numbers, within
/// +-3.47. std::normal_distribution and logarithms may differ from one library to the next; this cannot.
constexpr float gaussian(std::uint64_t bits) {
  const auto part = [&](int shift) { return static_cast<std::int32_t>((bits >> shift) & 0xfff); };
  const std::int32_t sum = part(0) + part(12) + part(24) + part(36);  // mean 2 * 4095
  return static_cast<float>(sum - 2 * 4095) * 4.22852e-4f;            // 1 / sqrt(4 * (4096^2 - 1) / 12)
}

/// A stream of random numbers for the layout of a scene. The order of draws decides the scene, so a call has
/// at most one draw among its arguments: their order of evaluation is fixed only in braces.
class Random {
 public:
  explicit Random(std::uint64_t seed) : key_(mix(seed)) {}

  std::uint64_t bits() { return mix(key_, count_++); }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * uniform(bits()); }
  /// Uniform integer in [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(uniform(bits()) * static_cast<double>(high - low + 1));
  }
  bool chance(double probability) { return uniform(bits()) < probability; }

 private:
  std::uint64_t key_, count_ = 0;
};

}  // namespace saccade::scene
