#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::int64_t> of_all = 0;
thread_local std::int64_t of_this_thread = 0;
}  // namespace

// Not inlined: compilers may remove pairs of new and delete that they see, and GCC would warn of free().
[[gnu::noinline]] void* operator new(std::size_t size) {
  of_all.fetch_add(1, std::memory_order_relaxed);
  ++of_this_thread;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace saccade {

std::int64_t allocations() { return of_all; }
std::int64_t allocations_of_this_thread() { return of_this_thread; }

}  // namespace saccade
