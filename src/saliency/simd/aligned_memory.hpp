#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <new>

namespace saccade {

/// Memory for `count` values, aligned for every vector; not initialised. Throws std::bad_alloc, where
/// Highway's own function returns null.
template <typename T>
hwy::AlignedFreeUniquePtr<T[]> allocate_aligned(std::size_t count) {
  auto memory = hwy::AllocateAligned<T>(count);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace saccade
