#include "attention/simd/cell_points.hpp"

#include <algorithm>
#include <bit>

#include "attention/simd/cell_pixels.hpp"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "attention/simd/cell_points.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "attention/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

// Pixel p of each cell is added to the sums of lane p, so that these do not depend on the size of vectors.
constexpr std::size_t kPixels = std::tuple_size_v<CellBlock>;
using BlockTag = hn::CappedTag<float, kPixels>;
using V = hn::VFromD<BlockTag>;
constexpr std::size_t kLanes = hn::MaxLanes(BlockTag()), kVectors = kPixels / kLanes;

// Pixels first.. of a cell, from as many rows as a vector holds.
template <typename D>
requires(hn::MaxLanes(D()) <= kCellPx) HWY_INLINE hn::VFromD<D> load_pixels(D d, const CellPixels& pixels,
                                                                            std::size_t first) {
  return hn::LoadU(d, pixels.row(static_cast<int>(first / kCellPx)) + first % kCellPx);
}

#if HWY_TARGET <= HWY_AVX2
template <typename D>
requires(hn::MaxLanes(D()) > kCellPx) HWY_INLINE hn::VFromD<D> load_pixels(D d, const CellPixels& pixels,
                                                                           std::size_t first) {
  const hn::Half<D> half;
  return hn::Combine(d, load_pixels(half, pixels, first + hn::MaxLanes(half)),
                     load_pixels(half, pixels, first));
}
#endif

template <typename M>
HWY_INLINE unsigned bits_of(M mask) {
  std::array<std::uint8_t, 8> bytes{};  // StoreMaskBits() may write 8
  hn::StoreMaskBits(BlockTag(), mask, bytes.data());
  return (bytes[0] | static_cast<unsigned>(bytes[1]) << 8) & ((1U << kLanes) - 1);
}

class PointAdder {
 public:
  HWY_INLINE PointAdder() {
    const BlockTag d;
    for (std::size_t k = 0; k < kVectors; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sum_[k][axis] = hn::Zero(d);
        low_[k][axis] = hn::Set(d, PointSums::kFar), high_[k][axis] = hn::Set(d, -PointSums::kFar);
      }
  }

  /// Adds the pixels of a cell, and gives a bit for each that was added.
  HWY_INLINE unsigned add(const CellPixels& pixels, float depth, float reach, const CellBlock& ray_x,
                          const CellBlock& ray_y) {
    const BlockTag d;
    unsigned bits = 0;
    for (std::size_t k = 0; k < kVectors; ++k) {
      const V z = load_pixels(d, pixels, k * kLanes);
      const auto near = hn::Le(hn::Abs(hn::Sub(z, hn::Set(d, depth))), hn::Set(d, reach));
      const auto on_it = hn::And(near, hn::Gt(z, hn::Zero(d)));
      const V x = hn::Mul(hn::LoadU(d, ray_x.data() + k * kLanes), z),
              y = hn::Mul(hn::LoadU(d, ray_y.data() + k * kLanes), z);
      add(k, 0, on_it, x), add(k, 1, on_it, y), add(k, 2, on_it, z);
      bits |= bits_of(on_it) << k * kLanes;
    }
    total_.count += std::popcount(bits);
    // Of few cells, so that float holds the sums well.
    if (++cells_ % 64 == 0) flush();
    return bits;
  }

  HWY_INLINE PointSums total() {
    flush();
    const BlockTag d;
    for (std::size_t k = 0; k < kVectors; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        total_.low[axis] = std::min(total_.low[axis], hn::GetLane(hn::MinOfLanes(d, low_[k][axis])));
        total_.high[axis] = std::max(total_.high[axis], hn::GetLane(hn::MaxOfLanes(d, high_[k][axis])));
      }
    return total_;
  }

 private:
  template <typename M>
  HWY_INLINE void add(std::size_t k, std::size_t axis, M on_it, V value) {
    sum_[k][axis] = hn::Add(sum_[k][axis], hn::IfThenElseZero(on_it, value));
    low_[k][axis] = hn::IfThenElse(on_it, hn::Min(low_[k][axis], value), low_[k][axis]);
    high_[k][axis] = hn::IfThenElse(on_it, hn::Max(high_[k][axis], value), high_[k][axis]);
  }

  HWY_INLINE void flush() {
    const BlockTag d;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < kVectors; ++k) {
        std::array<float, kLanes> lanes;
        hn::StoreU(sum_[k][axis], d, lanes.data());
        for (const float lane : lanes) total_.sum[axis] += static_cast<double>(lane);
        sum_[k][axis] = hn::Zero(d);
      }
  }

  V sum_[kVectors][3], low_[kVectors][3], high_[kVectors][3];
  int cells_ = 0;
  PointSums total_;
};

HWY_INLINE void paint(const CellPixels& pixels, unsigned bits, int row, int col, std::uint16_t rank,
                      cv::Mat1w& masks) {
  for (int v = 0; v < pixels.rows(); ++v, bits >>= kCellPx) {
    std::uint16_t* const mask = masks[row * kCellPx + v] + col * kCellPx;
    for (int u = 0; u < pixels.cols(); ++u)
      mask[u] = static_cast<std::uint16_t>((bits >> u & 1) != 0 ? rank : mask[u]);
  }
}

PointSums paint_points(const CellImage& image, std::span<const int> cells, float same_surface,
                       std::uint16_t rank, cv::Mat1w& masks) {
  PointAdder points;
  for (const int i : cells) {
    const int row = i / image.cell_cols, col = i % image.cell_cols;
    const CellPixels pixels(image.depth_mm, row, col);
    const float z0 = image.cell_depth[i];
    const unsigned bits =
        points.add(pixels, z0, same_surface * z0, image.ray_x[static_cast<std::size_t>(col)],
                   image.ray_y[static_cast<std::size_t>(row)]);
    paint(pixels, bits, row, col, rank, masks);
  }
  return points.total();
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(paint_points);
}  // namespace

PointSums paint_points(const CellImage& image, std::span<const int> cells, float same_surface,
                       std::uint16_t rank, cv::Mat1w& masks) {
  return HWY_DYNAMIC_DISPATCH(paint_points)(image, cells, same_surface, rank, masks);
}

}  // namespace saccade
#endif  // HWY_ONCE
