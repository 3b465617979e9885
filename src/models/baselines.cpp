#include "models/baselines.hpp"

#include <cmath>
#include <cstdint>

#include "models/image.hpp"

namespace saccade {
namespace {

// The finaliser of SplitMix64: makes well mixed bits from counters.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

// The Gaussian of the centre model at position i of a line of n pixels.
float gaussian(int i, int n) {
  constexpr double kSigma = 0.25;
  const double x = (i - (n - 1) / 2.0) / (kSigma * n);
  return static_cast<float>(std::exp(-x * x / 2));
}

void begin(const Frame& frame, SaliencyMaps& maps) {
  maps.levels.clear();
  maps.normals.release();
  maps.master.create(frame.size());
}

}  // namespace

void RandomModel::compute(const Frame& frame, RequestedOutputs, SaliencyMaps& maps, StageTimes& times) {
  const StageTimer timer(times, Stage::symmetry);
  begin(frame, maps);
  const std::uint64_t seed = mix(static_cast<std::uint64_t>(frame.index));
  for_row_bands(pool_, maps.master.rows, [&](int first, int last) {
    for (int r = first; r < last; ++r)
      for (int c = 0; c < maps.master.cols; ++c) {
        const std::uint64_t pixel = static_cast<std::uint64_t>(r) << 32 | static_cast<std::uint64_t>(c);
        constexpr float kStep = 1.0F / (1 << 24);
        maps.master(r, c) = static_cast<float>(mix(seed ^ pixel) >> 40) * kStep;
      }
  });
}

void CentreModel::compute(const Frame& frame, RequestedOutputs, SaliencyMaps& maps, StageTimes& times) {
  const StageTimer timer(times, Stage::symmetry);
  begin(frame, maps);
  const cv::Size size = frame.size();
  across_.resize(static_cast<std::size_t>(size.width));
  for (int c = 0; c < size.width; ++c) across_[static_cast<std::size_t>(c)] = gaussian(c, size.width);
  for_row_bands(pool_, size.height, [&](int first, int last) {
    for (int r = first; r < last; ++r) {
      const float down = gaussian(r, size.height);
      for (int c = 0; c < size.width; ++c) maps.master(r, c) = across_[static_cast<std::size_t>(c)] * down;
    }
  });
}

}  // namespace saccade
