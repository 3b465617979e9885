#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace saccade {

/// During its lifetime this thread's floating-point unit replaces denormal operands and results by 0.
/// Denormals arise where surfaces are flat, carry no information there, and cost a hundred cycles each.
class DenormalsAreZero {
 public:
#if defined(__SSE2__)
  DenormalsAreZero() : saved_(_mm_getcsr()) {
    constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
    _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero);
  }
  ~DenormalsAreZero() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#elif defined(__aarch64__)
  DenormalsAreZero() {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    constexpr std::uint64_t kFlushToZero = std::uint64_t{1} << 24;
    asm volatile("msr fpcr, %0" ::"r"(saved_ | kFlushToZero));
  }
  ~DenormalsAreZero() { asm volatile("msr fpcr, %0" ::"r"(saved_)); }

 private:
  std::uint64_t saved_;
#else
  DenormalsAreZero() {}  // slower, but equally correct
  ~DenormalsAreZero() {}
#endif

 public:
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;
};

}  // namespace saccade
