#pragma once

#include <cstddef>
#include <utility>

#include <readerwriterqueue/readerwritercircularbuffer.h>

namespace saccade {

/// A bounded lock-free queue from one producer thread to one consumer thread, which sleep while they wait.
/// The pipeline gives every ring room for all slots and an end mark, so push() never waits.
template <typename T>
class Ring {
 public:
  explicit Ring(std::size_t capacity) : queue_(capacity) {}

  /// Producer thread only.
  void push(T item) { queue_.wait_enqueue(std::move(item)); }

  /// Consumer thread only; waits for an item.
  T pop() {
    T item{};
    queue_.wait_dequeue(item);
    return item;
  }

 private:
  moodycamel::BlockingReaderWriterCircularBuffer<T> queue_;
};

}  // namespace saccade
