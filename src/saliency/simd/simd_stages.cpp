#include "saliency/simd/simd_stages.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"

// Skip targets that users cannot select, and scalable-vector targets.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "saliency/simd/simd_stages.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "saliency/simd/master_map-inl.hpp"
#include "saliency/simd/normals-inl.hpp"
#include "saliency/simd/pyramid-inl.hpp"
#include "saliency/simd/symmetry_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

const SimdStages* get_stages() {
#if HWY_TARGET == HWY_AVX3
  constexpr std::string_view name = "avx512";
#elif HWY_TARGET == HWY_AVX2
  constexpr std::string_view name = "avx2";
#elif HWY_TARGET == HWY_SSE4
  constexpr std::string_view name = "sse4";
#elif HWY_TARGET == HWY_NEON
  constexpr std::string_view name = "neon";
#else
  constexpr std::string_view name = "scalar";
#endif
  static constexpr SimdStages stages{name,       kLanes,      kRunsFromReach, load_rows,
                                     halve_rows, normal_rows, symmetry_rows,  add_upsampled_rows};
  return &stages;
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {

HWY_EXPORT(get_stages);

struct InstructionSet {
  std::string_view name;
  std::int64_t target;  // Highway's bit; 0 = the scalar fallback
};

// From the lowest to the highest.
constexpr std::array<InstructionSet, 5> kSets = {
    {{"scalar", 0}, {"sse4", HWY_SSE4}, {"neon", HWY_NEON}, {"avx2", HWY_AVX2}, {"avx512", HWY_AVX3}}};

bool can_run(const InstructionSet& set) {
  return set.target == 0 || (set.target & HWY_TARGETS & hwy::SupportedTargets()) != 0;
}

// Index in kSets of the set named `simd`, or for "auto" and "" of the highest that can run. Throws Error
// (usage), which names the setting `who`.
std::size_t highest_allowed(const std::string& simd, const std::string& who) {
  std::vector<std::string_view> runnable = {"auto"};
  std::size_t best = 0;
  std::optional<std::size_t> requested;
  for (std::size_t i = 0; i < kSets.size(); ++i) {
    if (!can_run(kSets[i])) continue;
    runnable.push_back(kSets[i].name);
    best = i;
    if (kSets[i].name == simd) requested = i;
  }
  if (simd.empty() || simd == "auto") return best;
  if (!requested)
    throw usage_error("this machine or build cannot run the instruction set", fmt::format("{}={}", who, simd),
                      fmt::format("try one of {}", fmt::join(runnable, ", ")));
  return *requested;
}

}  // namespace

const SimdStages& choose_simd_stages(const std::string& simd) {
  const char* environment = std::getenv("SACCADE_SIMD");
  const std::size_t set = std::min(highest_allowed(simd, "simd"),
                                   highest_allowed(environment ? environment : "", "SACCADE_SIMD"));
  hwy::ChosenTarget chosen;
  chosen.Update(kSets[set].target);
  return *HWY_DISPATCH_TABLE(get_stages)[chosen.GetIndex()]();
}

}  // namespace saccade
#endif  // HWY_ONCE
