// What the files of this folder share; compiled once for each instruction set.
#if defined(SACCADE_ATTENTION_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_ATTENTION_LANES_INL
#undef SACCADE_ATTENTION_LANES_INL
#else
#define SACCADE_ATTENTION_LANES_INL
#endif

#include <cstddef>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Calls work(d, i) for vectors, with the tag d, of the elements from i on, until all of begin..end have been
/// in one. Those of the last vector may have been in the one before; so `work` must not read what it writes,
/// unless doing so twice is doing so once.
template <typename Work>
HWY_INLINE void for_lanes(std::size_t begin, std::size_t end, const Work& work) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = begin;
  if (end < begin + lanes) {
    for (; i < end; ++i) work(hn::CappedTag<float, 1>(), i);
    return;
  }
  for (; i + lanes <= end; i += lanes) work(d, i);
  if (i < end) work(d, end - lanes);
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
