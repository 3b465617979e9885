// Vector types and small functions of the stages, compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_VECTORS_INL
#undef SACCADE_SALIENCY_VECTORS_INL
#else
#define SACCADE_SALIENCY_VECTORS_INL
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Highway's names: a tag d, its vectors V and masks M, of floats (F), doubles (D) and 32-bit integers (I).
// DHF and DHI have as many lanes as a vector of doubles, half of DF's and DI's.
using DF = hn::ScalableTag<float>;
using DD = hn::ScalableTag<double>;
using DI = hn::Rebind<std::int32_t, DF>;
using DHF = hn::Rebind<float, DD>;
using DHI = hn::Rebind<std::int32_t, DD>;
using VF = hn::Vec<DF>;
using VD = hn::Vec<DD>;
using VI = hn::Vec<DI>;
using MF = hn::Mask<DF>;

constexpr DF df{};
constexpr DD dd{};
constexpr DI di{};
constexpr DHF dhf{};
constexpr DHI dhi{};

constexpr int kLanes = HWY_LANES(float), kDoubleLanes = HWY_LANES(double);

constexpr int round_up(int value, int step) { return (value + step - 1) / step * step; }

HWY_INLINE VF set(float x) { return hn::Set(df, x); }
HWY_INLINE VF set(double x) { return hn::Set(df, static_cast<float>(x)); }
HWY_INLINE VF zero() { return hn::Zero(df); }
HWY_INLINE VF load(const float* p) { return hn::LoadU(df, p); }

/// The integer nearest to each lane; it must fit 32 bits.
HWY_INLINE VI nearest(VF v) {
#if HWY_TARGET <= HWY_AVX3
  return VI{_mm512_cvtps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return VI{_mm256_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}

/// v as unsigned integers, shifted right.
HWY_INLINE VI shift_right(VI v, int bits) {
  constexpr hn::RebindToUnsigned<DI> tag;
  return hn::BitCast(di, hn::ShiftRightSame(hn::BitCast(tag, v), bits));
}

/// A vector of three floats for each pixel.
struct Vec3 {
  VF x, y, z;
};

HWY_INLINE VF dot(const Vec3& a, const Vec3& b) {
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
HWY_INLINE Vec3 operator*(const Vec3& a, VF s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }

// Newton steps that bring the processor's estimates to nearly full precision: estimates have 8 bits on NEON,
// 12 on SSE and AVX2, 14 on AVX-512. The scalar fallback divides.
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
constexpr int kNewtonSteps = 0;
#elif HWY_TARGET <= HWY_AVX3
constexpr int kNewtonSteps = 1;
#else
constexpr int kNewtonSteps = 2;
#endif

/// 1/x for x > 0, within 2 units in the last place.
HWY_INLINE VF reciprocal(VF x) {
  if constexpr (kNewtonSteps == 0) return hn::Div(set(1.0f), x);
  VF y = hn::ApproximateReciprocal(x);
  for (int i = 0; i < kNewtonSteps; ++i) y = hn::MulAdd(y, hn::NegMulAdd(x, y, set(1.0f)), y);
  return y;
}

/// 1/sqrt(x) for x > 0, within 2 units in the last place.
HWY_INLINE VF reciprocal_sqrt(VF x) {
  if constexpr (kNewtonSteps == 0) return hn::Div(set(1.0f), hn::Sqrt(x));
  VF y = hn::ApproximateReciprocalSqrt(x);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const VF residual = hn::NegMulAdd(hn::Mul(x, y), y, set(1.0f));
    y = hn::MulAdd(hn::Mul(y, residual), set(0.5f), y);
  }
  return y;
}

/// v, kept in a register. GCC would otherwise reload a value for each use, and the inner loop is limited by
/// loads that cross cache lines.
HWY_INLINE VF in_register(VF v) {
#if HWY_COMPILER_GCC_ACTUAL && HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  asm("" : "+v"(v.raw));
#endif
  return v;
}
HWY_INLINE VI in_register(VI v) {
#if HWY_COMPILER_GCC_ACTUAL && HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  asm("" : "+v"(v.raw));
#endif
  return v;
}
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE MF in_register(MF m) { return m; }
#endif

/// The lanes of a mask as bits, lane 0 the lowest.
HWY_INLINE unsigned bits_of(MF m) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(df, m, reinterpret_cast<std::uint8_t*>(&bits));
  return static_cast<unsigned>(bits);
}

/// Moves the lanes of a mask to the front of a vector; the lanes after them are unspecified. (On AVX2 g++
/// makes Highway's Compress copy its table to the stack.)
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
class LanePacker {
 public:
  HWY_INLINE explicit LanePacker(MF m) : mask_(hn::RebindMask(di, m)) {}
  HWY_INLINE std::size_t size() const { return hn::CountTrue(di, mask_); }
  HWY_INLINE VI operator()(VI v) const { return hn::Compress(v, mask_); }

 private:
  hn::Mask<DI> mask_;
};
#else
/// For each byte, the positions of its ones.
struct BitPositions {
  std::uint8_t of[256][8];
  constexpr BitPositions() : of() {
    for (unsigned bits = 0; bits < 256; ++bits)
      for (unsigned bit = 0, n = 0; bit < 8; ++bit)
        if (bits >> bit & 1) of[bits][n++] = static_cast<std::uint8_t>(bit);
  }
};
inline constexpr BitPositions kBitPositions;

class LanePacker {
 public:
  HWY_INLINE explicit LanePacker(MF m) {
    const unsigned bits = bits_of(m);
    size_ = static_cast<std::size_t>(std::popcount(bits));
    constexpr hn::Rebind<std::uint8_t, DI> bytes;
    positions_ = hn::PromoteTo(di, hn::LoadU(bytes, kBitPositions.of[bits]));
  }
  HWY_INLINE std::size_t size() const { return size_; }
  HWY_INLINE VI operator()(VI v) const { return hn::TableLookupLanes(v, hn::IndicesFromVec(di, positions_)); }

 private:
  std::size_t size_;
  VI positions_;
};
#endif

/// The lanes that enter a sum: a mask if the instruction set has masked sums, else factors 1 and 0.
#if HWY_TARGET <= HWY_AVX3
using Selection = MF;
HWY_INLINE Selection select(MF m) { return m; }
HWY_INLINE VF add_where(Selection m, VF v, VF sum) {
  return VF{_mm512_mask_add_ps(sum.raw, m.raw, sum.raw, v.raw)};
}
HWY_INLINE VI add_where(MF m, VI v, VI sum) {
  return VI{_mm512_mask_add_epi32(sum.raw, m.raw, sum.raw, v.raw)};
}
/// sum + a * b where m, else sum. `ab` is a * b, for instruction sets without masked multiply-add.
HWY_INLINE VF add_product_where(Selection m, VF a, VF b, VF, VF sum) {
  return VF{_mm512_mask3_fmadd_ps(a.raw, b.raw, sum.raw, m.raw)};
}
#else
using Selection = VF;
HWY_INLINE Selection select(MF m) { return hn::IfThenElseZero(m, hn::Set(df, 1.0f)); }
HWY_INLINE VF add_where(Selection m, VF v, VF sum) { return hn::MulAdd(m, v, sum); }
HWY_INLINE VI add_where(MF m, VI v, VI sum) {
  return hn::Add(sum, hn::IfThenElseZero(hn::RebindMask(di, m), v));
}
HWY_INLINE VF add_product_where(Selection m, VF, VF, VF ab, VF sum) { return hn::MulAdd(m, ab, sum); }
#endif

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
