#include "models/symmetry2d.hpp"

#include <cmath>

#include "models/grey_pairs.hpp"

namespace saccade {
namespace {

// The inner loops run over the columns without branches, so that the compiler vectorises them.

class GreyMeasure : public PairMeasure {
 public:
  int channels() const override { return 1; }
  int planes() const override { return kCount; }

  void set_moments(const float* gx, const float* gy, int width, MomentPlanes& moments, int r) const override {
    float* cosine = moments.row(kCos, r);
    float* sine = moments.row(kSin, r);
    float* strength = moments.row(kStrength, r);
    for (int c = 0; c < width; ++c) {
      const float m = std::sqrt(gx[c] * gx[c] + gy[c] * gy[c]), scale = m > 0 ? 1 / m : 0;
      cosine[c] = gx[c] * scale;
      sine[c] = gy[c] * scale;
      strength[c] = std::log1p(m);
    }
  }

  void add_pairs(const MomentPlanes& moments, int r, const std::vector<MirrorPair>& pairs, float* score,
                 int width) const override {
    std::vector<GreyPairRows> rows;
    rows.reserve(pairs.size());
    for (const MirrorPair& pair : pairs) {
      const int i = r + pair.dy, j = r - pair.dy;
      rows.push_back({moments.row(kCos, i) + pair.dx, moments.row(kSin, i) + pair.dx,
                      moments.row(kStrength, i) + pair.dx, moments.row(kCos, j) - pair.dx,
                      moments.row(kSin, j) - pair.dx, moments.row(kStrength, j) - pair.dx});
    }
    add_grey_pairs(pairs, rows, score, width);
  }

 private:
  enum { kCos, kSin, kStrength, kCount };
};

// With L = log(1 + m), a sum over all pairs of channels is a product of sums over the channels:
//   cos^2(gi + gj) = (1 + cos 2gi cos 2gj - sin 2gi sin 2gj)/2, so that
//   2 * contribution = A_i A_j + B_i B_j - C_i C_j with the sums over channels
//   A = L cos^2 g, B = L cos^2 g cos 2g, C = L cos^2 g sin 2g.
// These are sums of L, L cos 2t, L sin 2t, L cos 4t and L sin 4t, rotated by alpha.
class ColourMeasure : public PairMeasure {
 public:
  int channels() const override { return 3; }
  int planes() const override { return kCount; }

  void set_moments(const float* gx, const float* gy, int width, MomentPlanes& moments, int r) const override {
    for (int c = 0; c < width; ++c) {
      float sums[kCount] = {};
      for (int k = 3 * c; k < 3 * c + 3; ++k) {
        const float m2 = gx[k] * gx[k] + gy[k] * gy[k], scale = m2 > 0 ? 1 / m2 : 0;
        const float cos2 = (gx[k] * gx[k] - gy[k] * gy[k]) * scale, sin2 = 2 * gx[k] * gy[k] * scale;
        const float strength = std::log1p(std::sqrt(m2));
        sums[kStrength] += strength;
        sums[kCos2] += strength * cos2;
        sums[kSin2] += strength * sin2;
        sums[kCos4] += strength * (cos2 * cos2 - sin2 * sin2);
        sums[kSin4] += strength * (2 * cos2 * sin2);
      }
      for (int p = 0; p < kCount; ++p) moments.row(p, r)[c] = sums[p];
    }
  }

  void add_pairs(const MomentPlanes& moments, int r, const std::vector<MirrorPair>& pairs, float* score,
                 int width) const override {
    for (const MirrorPair& pair : pairs) {
      const float *i[kCount], *j[kCount];
      for (int p = 0; p < kCount; ++p) {
        i[p] = moments.row(p, r + pair.dy) + pair.dx;
        j[p] = moments.row(p, r - pair.dy) - pair.dx;
      }
      add_pair(pair, i[0], i[1], i[2], i[3], i[4], j[0], j[1], j[2], j[3], j[4], score, width);
    }
  }

 private:
  enum { kStrength, kCos2, kSin2, kCos4, kSin4, kCount };

  static void add_pair(const MirrorPair& pair, const float* l_i, const float* c2_i, const float* s2_i,
                       const float* c4_i, const float* s4_i, const float* l_j, const float* c2_j,
                       const float* s2_j, const float* c4_j, const float* s4_j, float* score, int width) {
    const float cos2a = pair.cos2a, sin2a = pair.sin2a;
    const float cos4a = cos2a * cos2a - sin2a * sin2a, sin4a = 2 * sin2a * cos2a;
    const float weight = pair.weight / 2 / 16;  // a, b and s below use four times A, B and C
    for (int c = 0; c < width; ++c) {
      // Of 2g and 4g: the moments rotated by alpha.
      const float cos2_i = c2_i[c] * cos2a + s2_i[c] * sin2a, sin2_i = s2_i[c] * cos2a - c2_i[c] * sin2a;
      const float cos4_i = c4_i[c] * cos4a + s4_i[c] * sin4a, sin4_i = s4_i[c] * cos4a - c4_i[c] * sin4a;
      const float cos2_j = c2_j[c] * cos2a + s2_j[c] * sin2a, sin2_j = s2_j[c] * cos2a - c2_j[c] * sin2a;
      const float cos4_j = c4_j[c] * cos4a + s4_j[c] * sin4a, sin4_j = s4_j[c] * cos4a - c4_j[c] * sin4a;
      const float a = (l_i[c] + cos2_i) * (l_j[c] + cos2_j) * 4;
      const float b = (2 * cos2_i + l_i[c] + cos4_i) * (2 * cos2_j + l_j[c] + cos4_j);
      const float s = (2 * sin2_i + sin4_i) * (2 * sin2_j + sin4_j);
      score[c] += std::max(0.0F, a + b - s) * weight;
    }
  }
};

}  // namespace

std::unique_ptr<MirrorPairModel> make_symmetry2d(WorkerPool& pool, int last_level) {
  return std::make_unique<MirrorPairModel>("symmetry2d", std::make_unique<GreyMeasure>(), pool, last_level);
}

std::unique_ptr<MirrorPairModel> make_colour_symmetry2d(WorkerPool& pool) {
  return std::make_unique<MirrorPairModel>("colour_symmetry2d", std::make_unique<ColourMeasure>(), pool);
}

}  // namespace saccade
