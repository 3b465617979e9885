#include "models/colour_opponency.hpp"

#include <algorithm>

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "models/colour_opponency.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <typename D>
hn::VFromD<hn::RebindToSigned<D>> load_channel(D, const std::uint8_t* channel) {
  return hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(hn::Rebind<std::uint8_t, D>(), channel));
}

template <typename D>
hn::VFromD<D> find_intensity_at(D d, const ColourRows& bgr, float* intensity, std::size_t c) {
  const auto sum =
      hn::Add(hn::Add(load_channel(d, bgr[0] + c), load_channel(d, bgr[1] + c)), load_channel(d, bgr[2] + c));
  const auto here = hn::Div(hn::ConvertTo(d, sum), hn::Set(d, 3.0F * 255));
  hn::StoreU(here, d, intensity + c);
  return here;
}

float find_intensity(const ColourRows& bgr, float* intensity, std::size_t width) {
  const hn::ScalableTag<float> d;
  auto largest = hn::Zero(d);
  std::size_t c = 0;
  for (; c + hn::Lanes(d) <= width; c += hn::Lanes(d))
    largest = hn::Max(largest, find_intensity_at(d, bgr, intensity, c));
  float found = hn::GetLane(hn::MaxOfLanes(d, largest));
  for (; c < width; ++c)
    found = std::max(found, hn::GetLane(find_intensity_at(hn::CappedTag<float, 1>(), bgr, intensity, c)));
  return found;
}

template <typename D>
void find_opponency_at(D d, const ColourRows& bgr, const float* intensity, float least, float* red_green,
                       float* blue_yellow, std::size_t c) {
  const auto zero = hn::Zero(d), half = hn::Set(d, 0.5F);
  const auto here = hn::LoadU(d, intensity + c);
  const auto inverse = hn::Div(hn::Set(d, 1.0F), hn::Mul(hn::Set(d, 255.0F), here));
  const auto scale = hn::IfThenElseZero(hn::Gt(here, hn::Set(d, least)), inverse);
  const auto channel = [&](std::size_t k) {
    return hn::Mul(hn::ConvertTo(d, load_channel(d, bgr[k] + c)), scale);
  };
  const auto b = channel(0), g = channel(1), r = channel(2);
  const auto mean = [&](auto x, auto y) { return hn::Mul(hn::Add(x, y), half); };
  const auto red = hn::Max(zero, hn::Sub(r, mean(g, b))), green = hn::Max(zero, hn::Sub(g, mean(r, b)));
  const auto blue = hn::Max(zero, hn::Sub(b, mean(r, g)));
  const auto yellow = hn::Max(zero, hn::Sub(hn::Sub(mean(r, g), hn::Mul(hn::Abs(hn::Sub(r, g)), half)), b));
  hn::StoreU(hn::Sub(red, green), d, red_green + c);
  hn::StoreU(hn::Sub(blue, yellow), d, blue_yellow + c);
}

void find_opponency(const ColourRows& bgr, const float* intensity, float least, float* red_green,
                    float* blue_yellow, std::size_t width) {
  const hn::ScalableTag<float> d;
  std::size_t c = 0;
  for (; c + hn::Lanes(d) <= width; c += hn::Lanes(d))
    find_opponency_at(d, bgr, intensity, least, red_green, blue_yellow, c);
  for (; c < width; ++c)
    find_opponency_at(hn::CappedTag<float, 1>(), bgr, intensity, least, red_green, blue_yellow, c);
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(find_intensity);
HWY_EXPORT(find_opponency);
}  // namespace

float find_intensity(const ColourRows& bgr, float* intensity, std::size_t width) {
  return HWY_DYNAMIC_DISPATCH(find_intensity)(bgr, intensity, width);
}

void find_opponency(const ColourRows& bgr, const float* intensity, float least, float* red_green,
                    float* blue_yellow, std::size_t width) {
  HWY_DYNAMIC_DISPATCH(find_opponency)(bgr, intensity, least, red_green, blue_yellow, width);
}

}  // namespace saccade
#endif  // HWY_ONCE
