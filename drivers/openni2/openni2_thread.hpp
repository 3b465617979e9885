#pragma once

#include <memory>
#include <type_traits>

namespace saccade {

/// Calls `call(task)` as on_openni2_thread() does.
void run_on_openni2_thread(void (*call)(void* task), void* task);

/// Runs `task` on the one thread of this process that uses OpenNI2, after earlier tasks, and returns when it
/// is done. OpenNI2 remembers each thread that has ever called it, for its messages, and checks by
/// pthread_kill() whether they are alive when another calls it for the first time; for a thread that has
/// ended this crashes. So no thread that ends may call it, and this one never ends. May be called on any
/// thread, this one too. Rethrows the exceptions of `task`. Allocates nothing: frames are read in this way.
template <typename Task>
void on_openni2_thread(Task&& task) {
  using T = std::remove_reference_t<Task>;
  run_on_openni2_thread([](void* t) { (*static_cast<T*>(t))(); }, std::addressof(task));
}

}  // namespace saccade
