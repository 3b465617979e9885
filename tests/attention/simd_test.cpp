// What src/attention/simd computes, against plain loops, with every instruction set of this machine. Counts,
// marks and means are exact: nothing is fused, and sums are added in one order.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "attention/simd/cell_edges.hpp"
#include "attention/simd/cell_means.hpp"
#include "attention/simd/cell_normals.hpp"
#include "attention/simd/plane_cells.hpp"
#include "instruction_sets.hpp"

namespace saccade {
namespace {

// More than two vectors of the widest kind and a rest, and fewer than one of them.
constexpr std::size_t kCounts[] = {1, 3, 7, 16, 37, 90};

class Random {
 public:
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  bool one_in(unsigned n) { return engine_() % n == 0; }

  /// Depths of a slanted surface with noise, gaps and jumps.
  std::vector<float> depths(std::size_t count) {
    std::vector<float> z(count);
    for (std::size_t i = 0; i < count; ++i)
      z[i] = one_in(9) ? 0 : (one_in(6) ? 1500.0F : 900.0F) + static_cast<float>(i % 64) + between(0, 12);
    return z;
  }

 private:
  std::mt19937 engine_{17};
};

struct Image {
  std::vector<float> pixels;
  std::size_t width;

  PixelRows rows() const { return {&pixels[0], &pixels[width], &pixels[2 * width], &pixels[3 * width]}; }
  float at(std::size_t v, std::size_t u) const { return pixels[v * width + u]; }
};

TEST(CellMeans, DepthsAreThoseOfTheSlowForm) {
  Random random;
  for (const std::size_t cells : kCounts) {
    Image image{std::vector<float>(4 * 4 * cells), 4 * cells};
    std::vector<float> expected(cells);
    for (std::size_t c = 0; c < cells; ++c) {
      const float z = random.between(500, 5000), spread = random.between(0, 0.04F) * z;
      const bool none = random.one_in(5), gap = random.one_in(5);
      for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t u = 0; u < 4; ++u)
          image.pixels[v * image.width + 4 * c + u] = none ? 0 : z + random.between(0, spread);
      if (gap) image.pixels[2 * image.width + 4 * c + 1] = 0;
      float low = 1e9F, high = 0;
      std::array<float, 4> column{};
      for (std::size_t u = 0; u < 4; ++u) {
        const auto p = [&](std::size_t v) { return image.at(v, 4 * c + u); };
        for (std::size_t v = 0; v < 4; ++v) low = std::min(low, p(v)), high = std::max(high, p(v));
        column[u] = (p(0) + p(1)) + (p(2) + p(3));
      }
      const float mean = ((column[0] + column[1]) + (column[2] + column[3])) / 16;
      expected[c] = low > 0 && high - low <= 0.02F * low ? mean : high > 0 ? kMixedDepth : 0;
    }
    with_each_instruction_set([&] {
      std::vector<float> depth(cells);
      mean_depths(image.rows(), 0.02F, depth.data(), cells);
      EXPECT_EQ(depth, expected);
    });
  }
}

TEST(CellMeans, ValuesAreThoseOfTheSlowForm) {
  Random random;
  for (const std::size_t cells : kCounts) {
    Image image{std::vector<float>(4 * 4 * cells), 4 * cells};
    for (float& value : image.pixels) value = random.between(0, 2);
    std::vector<double> expected(cells);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      expected[i % image.width / 4] += static_cast<double>(image.pixels[i]) / 16;
    std::vector<float> first;
    with_each_instruction_set([&] {
      std::vector<float> mean(cells);
      mean_values(image.rows(), mean.data(), cells);
      for (std::size_t c = 0; c < cells; ++c) EXPECT_NEAR(mean[c], expected[c], 1e-6) << c;
      if (first.empty()) first = mean;
      EXPECT_EQ(mean, first);
    });
  }
}

TEST(CellMeans, AddWeightedIsAsThePlainLoop) {
  Random random;
  for (const std::size_t count : kCounts) {
    std::vector<float> from(count + 4), expected(count);
    for (float& value : from) value = random.between(0, 2);
    const std::vector<const float*> rows = {&from[0], &from[3], &from[4]};
    const std::vector<float> weights = {0.3F, 0.2F, 0.5F};
    for (std::size_t i = 0; i < count; ++i) {
      expected[i] = rows[0][i] * weights[0];
      for (std::size_t k = 1; k < 3; ++k) expected[i] += rows[k][i] * weights[k];
    }
    with_each_instruction_set([&] {
      std::vector<float> out(count);
      add_weighted(rows, weights, out.data(), count);
      EXPECT_EQ(out, expected);
    });
  }
}

// A patch of cells with a normal for most of them.
struct Patch {
  std::vector<float> x, y, z, nx, ny, nz;

  Patch(Random& random, std::size_t count) : z(random.depths(count)) {
    for (auto* array : {&x, &y, &nx, &ny, &nz}) array->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (z[i] == 0) continue;
      x[i] = static_cast<float>(i % 64) * 4 + random.between(-1, 1), y[i] = static_cast<float>(i / 64) * 4;
      if (random.one_in(7)) continue;
      const float tilt = random.between(-0.5F, 0.5F), turn = random.between(-0.5F, 0.5F);
      const float length = std::sqrt(1 + tilt * tilt + turn * turn);
      nx[i] = tilt / length, ny[i] = turn / length, nz[i] = -1 / length;
    }
  }
  OrientedCells cells() const { return {x.data(), y.data(), z.data(), nx.data(), ny.data(), nz.data()}; }
};

TEST(CellEdges, ConcaveCellsAreThoseOfTheSlowForm) {
  Random random;
  constexpr std::size_t kStep = 2;
  const ConcaveLimit limit{.sine = 0.3F, .sine_per_metre = 0.1F, .reach = 0.05F};
  int edges = 0;
  for (const std::size_t count : kCounts) {
    const Patch p(random, count + 2 * kStep);
    std::vector<std::uint8_t> expected(count + 2 * kStep, 0);
    expected[kStep] = 1;  // one that is marked already stays so
    for (std::size_t i = kStep; i < count + kStep; ++i) {
      const std::size_t a = i - kStep, b = i + kStep;
      if (p.nz[a] == 0 || p.nz[b] == 0) continue;
      if (std::max(std::abs(p.z[a] - p.z[i]), std::abs(p.z[b] - p.z[i])) > 0.05F * p.z[i]) continue;
      const double u = static_cast<double>(p.x[b] - p.x[a]), v = static_cast<double>(p.y[b] - p.y[a]),
                   w = static_cast<double>(p.z[b] - p.z[a]);
      const double turn = static_cast<double>(p.nx[b] - p.nx[a]) * u +
                          static_cast<double>(p.ny[b] - p.ny[a]) * v +
                          static_cast<double>(p.nz[b] - p.nz[a]) * w;
      const double sine = 0.3 + 0.1 * std::max(0.0, static_cast<double>(p.z[i]) / 1000 - 1);
      if (turn / std::sqrt(u * u + v * v + w * w) < -sine) expected[i] = 1;
    }
    edges += static_cast<int>(std::count(expected.begin(), expected.end(), 1));
    with_each_instruction_set([&] {
      std::vector<std::uint8_t> marked(expected.size(), 0);
      marked[kStep] = 1;
      mark_concave(p.cells(), kStep, count + kStep, kStep, limit, marked.data());
      EXPECT_EQ(marked, expected);
    });
  }
  EXPECT_GT(edges, 10);
}

TEST(CellEdges, LinksAreThoseOfTheSlowForm) {
  Random random;
  int links = 0;
  for (const std::size_t count : kCounts) {
    const Patch p(random, count + 1);
    std::vector<std::uint8_t> expected(count);
    for (std::size_t a = 0; a < count; ++a) {
      const std::size_t b = a + 1;
      const double dx = static_cast<double>(p.x[b] - p.x[a]), dy = static_cast<double>(p.y[b] - p.y[a]),
                   dz = static_cast<double>(p.z[b] - p.z[a]);
      const auto off = [&](std::size_t i) {
        if (p.nz[i] == 0) return 1e9;
        return std::abs(static_cast<double>(p.nx[i]) * dx + static_cast<double>(p.ny[i]) * dy +
                        static_cast<double>(p.nz[i]) * dz);
      };
      const double z = static_cast<double>(p.z[a]), jump = 0.012 * z * std::max(1.0, z / 1000);
      expected[a] = p.z[a] > 0 && p.z[b] > 0 && std::min({std::abs(dz), off(a), off(b)}) < jump;
    }
    links += static_cast<int>(std::count(expected.begin(), expected.end(), 1));
    with_each_instruction_set([&] {
      std::vector<std::uint8_t> linked(count);
      find_linked(p.cells(), count, 1, 0.012F, linked.data());
      EXPECT_EQ(linked, expected);
    });
  }
  EXPECT_GT(links, 20);
}

// The fit itself is compared with a slow one in surface_grid_test.cpp.
TEST(CellNormals, AreTheSameWithEveryInstructionSet) {
  Random random;
  for (const std::size_t cols : kCounts) {
    const std::size_t stride = cols + 2 * kNormalReach;
    std::vector<float> z = random.depths(5 * stride), w(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) w[i] = z[i] > 0 ? 1 / z[i] : 0;
    std::vector<float> first;
    with_each_instruction_set([&] {
      std::vector<float> normals(3 * cols, -9);
      find_normals({z.data(), w.data(), stride}, Intrinsics::guess_for({160, 120}), 0.02F, 0, cols,
                   {&normals[0], &normals[cols], &normals[2 * cols]});
      if (first.empty()) first = normals;
      EXPECT_EQ(normals, first);
    });
    if (cols < 16) continue;
    EXPECT_GT(std::count_if(first.begin(), first.end(), [](float n) { return n != 0; }), 20);
    EXPECT_GT(std::count(first.begin(), first.end(), 0), 2);
  }
}

class PlaneCellsTest : public testing::Test {
 protected:
  // Every third cell lies off the plane 1/z = a*col + b*row + c.
  explicit PlaneCellsTest(std::size_t count = 1003) : col_(count), row_(count), w_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      col_[i] = static_cast<float>(i % 80), row_[i] = static_cast<float>(i / 80);
      const double exact = kA * static_cast<double>(col_[i]) + kB * static_cast<double>(row_[i]) + kC;
      w_[i] = static_cast<float>(exact) * (1 + (i % 3 == 0 ? 0.05F : 0.015F) * random_.between(-1, 1));
    }
  }
  PlaneCells cells() const { return {col_.data(), row_.data(), w_.data(), w_.size()}; }

  static constexpr double kA = 1e-6, kB = 3e-6, kC = 8e-4;
  Random random_;
  std::vector<float> col_, row_, w_;
};

TEST_F(PlaneCellsTest, CountsAsThePlainLoop) {
  constexpr auto kFloatA = static_cast<float>(kA), kFloatB = static_cast<float>(kB),
                 kFloatC = static_cast<float>(kC);
  int expected = 0;
  for (std::size_t i = 0; i < w_.size(); ++i)
    expected += std::abs(kFloatA * col_[i] + kFloatB * row_[i] + kFloatC - w_[i]) <= 0.012F * w_[i];
  ASSERT_GT(expected, 300);
  ASSERT_LT(expected, 900);
  with_each_instruction_set([&] {
    for (const int least : {0, expected - 1})
      EXPECT_EQ(count_in_plane(cells(), kFloatA, kFloatB, kFloatC, 0.012F, least), expected);
    for (const int least : {expected, expected + 100})
      EXPECT_LE(count_in_plane(cells(), kFloatA, kFloatB, kFloatC, 0.012F, least), least);
  });
}

TEST_F(PlaneCellsTest, SumsAsThePlainLoop) {
  PlaneSums slow;
  for (std::size_t i = 0; i < w_.size(); ++i) {
    const double u = static_cast<double>(col_[i]), v = static_cast<double>(row_[i]),
                 w = static_cast<double>(w_[i]);
    if (std::abs(kA * u + kB * v + kC - w) > 0.012 * w) continue;
    slow.n += 1, slow.u += u, slow.v += v, slow.uu += u * u, slow.vv += v * v, slow.uv += u * v;
    slow.w += w, slow.uw += u * w, slow.vw += v * w;
  }
  std::vector<PlaneSums> found;
  with_each_instruction_set([&] { found.push_back(sum_in_plane(cells(), kA, kB, kC, 0.012)); });
  for (const PlaneSums& fast : found) {
    for (double PlaneSums::*integer :
         {&PlaneSums::n, &PlaneSums::u, &PlaneSums::v, &PlaneSums::uu, &PlaneSums::vv, &PlaneSums::uv})
      EXPECT_EQ(fast.*integer, slow.*integer);
    for (double PlaneSums::*sum : {&PlaneSums::w, &PlaneSums::uw, &PlaneSums::vw}) {
      EXPECT_NEAR(fast.*sum / (slow.*sum), 1, 1e-13);
      EXPECT_EQ(fast.*sum, found.front().*sum);
    }
  }
}

}  // namespace
}  // namespace saccade
