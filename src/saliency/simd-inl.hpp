// Small helpers of the kernels, compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_SIMD_INL
#undef SACCADE_SALIENCY_SIMD_INL
#else
#define SACCADE_SALIENCY_SIMD_INL
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using V = hn::Vec<F>;
using M = hn::Mask<F>;
using Wide = hn::ScalableTag<double>;
using WideV = hn::Vec<Wide>;
using HalfF = hn::Rebind<float, Wide>;  // as many floats as there are doubles in a vector
using HalfWhole = hn::Rebind<std::int32_t, Wide>;
using Whole = hn::Rebind<std::int32_t, F>;
using W = hn::Vec<Whole>;

constexpr F kF{};
constexpr Wide kWide{};
constexpr HalfF kHalfF{};
constexpr HalfWhole kHalfWhole{};
constexpr Whole kWhole{};

constexpr int kLanes = HWY_LANES(float), kWideLanes = HWY_LANES(double);

constexpr int round_up(int value, int step) { return (value + step - 1) / step * step; }

HWY_INLINE V set(float x) { return hn::Set(kF, x); }
HWY_INLINE V set(double x) { return hn::Set(kF, static_cast<float>(x)); }
HWY_INLINE V zero() { return hn::Zero(kF); }
HWY_INLINE V load(const float* p) { return hn::LoadU(kF, p); }

/// The whole number nearest to each lane, which must fit.
HWY_INLINE W nearest(V v) {
#if HWY_TARGET <= HWY_AVX3
  return W{_mm512_cvtps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return W{_mm256_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}

/// The bits of v, which are those of a whole number without sign, moved down.
HWY_INLINE W shift_right(W v, int bits) {
  constexpr hn::RebindToUnsigned<Whole> tag;
  return hn::BitCast(kWhole, hn::ShiftRightSame(hn::BitCast(tag, v), bits));
}

/// Three floats a pixel.
struct Vec3 {
  V x, y, z;
};

HWY_INLINE V dot(const Vec3& a, const Vec3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
  return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
          hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
HWY_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vec3 operator*(const Vec3& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }

// Newton steps that bring the machine's estimates to nearly full precision: they have 8 bits on NEON, 12 on
// SSE and AVX2, 14 on AVX-512. The fallback without SIMD divides.
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
constexpr int kNewtonSteps = 0;
#elif HWY_TARGET <= HWY_AVX3
constexpr int kNewtonSteps = 1;
#else
constexpr int kNewtonSteps = 2;
#endif

/// 1/x for x > 0, within 2 units in the last place.
HWY_INLINE V reciprocal(V x) {
  if constexpr (kNewtonSteps == 0) return hn::Div(set(1.0f), x);
  V y = hn::ApproximateReciprocal(x);
  for (int i = 0; i < kNewtonSteps; ++i) y = hn::MulAdd(y, hn::NegMulAdd(x, y, set(1.0f)), y);
  return y;
}

/// 1/sqrt(x) for x > 0, within 2 units in the last place.
HWY_INLINE V reciprocal_sqrt(V x) {
  if constexpr (kNewtonSteps == 0) return hn::Div(set(1.0f), hn::Sqrt(x));
  V y = hn::ApproximateReciprocalSqrt(x);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const V residual = hn::NegMulAdd(hn::Mul(x, y), y, set(1.0f));
    y = hn::MulAdd(hn::Mul(y, residual), set(0.5f), y);
  }
  return y;
}

/// v, held in a register. Else compilers load a value anew for each of its uses, and loads that cross cache
/// lines are what the inner loop has too many of.
HWY_INLINE V in_register(V v) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  asm("" : "+v"(v.raw));
#endif
  return v;
}
HWY_INLINE W in_register(W v) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  asm("" : "+v"(v.raw));
#endif
  return v;
}
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE M in_register(M m) { return m; }
#endif

/// The lanes of a mask as bits, lane 0 the lowest.
HWY_INLINE unsigned bits_of(M m) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(kF, m, reinterpret_cast<std::uint8_t*>(&bits));
  return static_cast<unsigned>(bits);
}

/// Moves the lanes of a mask to the front of a vector; what follows them is anything.
/// (Highway's Compress copies its table to the stack on AVX2, as g++ compiles it.)
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
class LanePacker {
 public:
  HWY_INLINE explicit LanePacker(M m) : mask_(hn::RebindMask(kWhole, m)) {}
  HWY_INLINE std::size_t size() const { return hn::CountTrue(kWhole, mask_); }
  HWY_INLINE W operator()(W v) const { return hn::Compress(v, mask_); }

 private:
  hn::Mask<Whole> mask_;
};
#else
/// The places of the ones in a byte, then anything.
struct PlacesOfOnes {
  std::uint8_t of[256][8];
  constexpr PlacesOfOnes() : of() {
    for (unsigned bits = 0; bits < 256; ++bits)
      for (unsigned bit = 0, n = 0; bit < 8; ++bit)
        if (bits >> bit & 1) of[bits][n++] = static_cast<std::uint8_t>(bit);
  }
};
inline constexpr PlacesOfOnes kPlacesOfOnes;

class LanePacker {
 public:
  HWY_INLINE explicit LanePacker(M m) {
    const unsigned bits = bits_of(m);
    size_ = static_cast<std::size_t>(std::popcount(bits));
    constexpr hn::Rebind<std::uint8_t, Whole> kBytes;
    places_ = hn::PromoteTo(kWhole, hn::LoadU(kBytes, kPlacesOfOnes.of[bits]));
  }
  HWY_INLINE std::size_t size() const { return size_; }
  HWY_INLINE W operator()(W v) const { return hn::TableLookupLanes(v, hn::IndicesFromVec(kWhole, places_)); }

 private:
  std::size_t size_;
  W places_;
};
#endif

/// Which lanes' values enter a sum: a mask where sums can be masked, else 1 or 0 to be multiplied with.
#if HWY_TARGET <= HWY_AVX3
using Selection = M;
HWY_INLINE Selection select(M m) { return m; }
HWY_INLINE V add_where(Selection m, V v, V sum) {
  return V{_mm512_mask_add_ps(sum.raw, m.raw, sum.raw, v.raw)};
}
HWY_INLINE W add_where(M m, W v, W sum) { return W{_mm512_mask_add_epi32(sum.raw, m.raw, sum.raw, v.raw)}; }
/// sum + a * b where m, else sum; ab = a * b may be used instead.
HWY_INLINE V add_product_where(Selection m, V a, V b, V, V sum) {
  return V{_mm512_mask3_fmadd_ps(a.raw, b.raw, sum.raw, m.raw)};
}
#else
using Selection = V;
HWY_INLINE Selection select(M m) { return hn::IfThenElseZero(m, hn::Set(kF, 1.0f)); }
HWY_INLINE V add_where(Selection m, V v, V sum) { return hn::MulAdd(m, v, sum); }
HWY_INLINE W add_where(M m, W v, W sum) {
  return hn::Add(sum, hn::IfThenElseZero(hn::RebindMask(kWhole, m), v));
}
HWY_INLINE V add_product_where(Selection m, V, V, V ab, V sum) { return hn::MulAdd(m, ab, sum); }
#endif

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
