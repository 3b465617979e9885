#pragma once

#include <atomic>
#include <cstdint>

#include <readerwriterqueue/atomicops.h>

namespace saccade {

/// A lock-free triple buffer: each of two threads holds one item, and the mailbox a third, fresh or spare.
/// Each side exchanges its item for that of the mailbox, where a newer item replaces an older one. The
/// producer therefore never waits for the consumer, and nothing is allocated.
template <typename T>
class Mailbox {
 public:
  struct Exchange {
    T* item;        ///< for the producer to fill next
    bool replaced;  ///< the item is a fresh one that the consumer did not take in time
  };

  explicit Mailbox(T* spare) : place_(address(spare)) {}

  /// Producer thread only; never waits.
  Exchange put(T* fresh) {
    const std::uintptr_t before = place_.exchange(address(fresh) | kFresh, std::memory_order_acq_rel);
    const bool replaced = (before & kFresh) != 0;
    if (!replaced) wake_.signal();
    return {item(before), replaced};
  }

  /// Producer thread only: no more items will come.
  void close() { wake_.signal(); }

  /// Consumer thread only: waits for a fresh item and leaves `spare` in its place. `spare` may be null only
  /// if the producer no longer needs an item. Returns null when closed and empty; `spare` then stays with the
  /// caller.
  T* take(T* spare) {
    while (!wake_.wait()) {  // false: a signal handler ran
    }
    // There is one signal for each change from spare to fresh, and one for the end.
    const std::uintptr_t before = place_.exchange(address(spare), std::memory_order_acq_rel);
    return (before & kFresh) != 0 ? item(before) : nullptr;
  }

 private:
  static constexpr std::uintptr_t kFresh = 1;  // in the lowest bit, which is 0 in every address of a T
  static_assert(alignof(T) > 1);

  static std::uintptr_t address(T* item) { return reinterpret_cast<std::uintptr_t>(item); }
  static T* item(std::uintptr_t value) { return reinterpret_cast<T*>(value & ~kFresh); }

  std::atomic<std::uintptr_t> place_;
  moodycamel::spsc_sema::LightweightSemaphore wake_;
};

}  // namespace saccade
