// The peak rate of the machine: fused multiply-adds of single precision in registers, one thread. The
// operator's inner loop takes 23 such operations for each vector of neighbours.

#include <benchmark/benchmark.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/machine_bench.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Does 12 multiply-adds of a vector a round, enough to hide their latency; the result depends on all of
/// them.
float multiply_add(long rounds) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const auto factor = hn::Set(d, 0.999f), term = hn::Set(d, 0.001f);
  // Different initial values, so that the compiler cannot merge any two.
  auto s0 = hn::Set(d, 0.0f), s1 = hn::Set(d, 0.1f), s2 = hn::Set(d, 0.2f), s3 = hn::Set(d, 0.3f),
       s4 = hn::Set(d, 0.4f), s5 = hn::Set(d, 0.5f), s6 = hn::Set(d, 0.6f), s7 = hn::Set(d, 0.7f),
       s8 = hn::Set(d, 0.8f), s9 = hn::Set(d, 0.9f), s10 = hn::Set(d, 1.1f), s11 = hn::Set(d, 1.2f);
  for (long i = 0; i < rounds; ++i) {
    s0 = hn::MulAdd(s0, factor, term), s1 = hn::MulAdd(s1, factor, term);
    s2 = hn::MulAdd(s2, factor, term), s3 = hn::MulAdd(s3, factor, term);
    s4 = hn::MulAdd(s4, factor, term), s5 = hn::MulAdd(s5, factor, term);
    s6 = hn::MulAdd(s6, factor, term), s7 = hn::MulAdd(s7, factor, term);
    s8 = hn::MulAdd(s8, factor, term), s9 = hn::MulAdd(s9, factor, term);
    s10 = hn::MulAdd(s10, factor, term), s11 = hn::MulAdd(s11, factor, term);
  }
  const auto a = hn::Add(hn::Add(s0, s1), hn::Add(s2, s3)), b = hn::Add(hn::Add(s4, s5), hn::Add(s6, s7)),
             c = hn::Add(hn::Add(s8, s9), hn::Add(s10, s11));
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(a, hn::Add(b, c))));
}

long lanes() {
  return static_cast<long>(hwy::HWY_NAMESPACE::Lanes(hwy::HWY_NAMESPACE::ScalableTag<float>()));
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {

HWY_EXPORT(multiply_add);
HWY_EXPORT(lanes);

void peak_multiply_add(benchmark::State& state) {
  constexpr long kRounds = 100'000, kSumsOfRound = 12;
  for (auto _ : state) benchmark::DoNotOptimize(HWY_DYNAMIC_DISPATCH(multiply_add)(kRounds));
  const double vectors = static_cast<double>(state.iterations()) * kRounds * kSumsOfRound;
  state.counters["vectors/s"] = benchmark::Counter(vectors, benchmark::Counter::kIsRate);
  state.counters["flop/s"] = benchmark::Counter(
      2 * vectors * static_cast<double>(HWY_DYNAMIC_DISPATCH(lanes)()), benchmark::Counter::kIsRate);
}
BENCHMARK(peak_multiply_add);

}  // namespace
}  // namespace saccade
#endif
