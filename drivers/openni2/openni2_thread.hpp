#pragma once

#include <memory>
#include <type_traits>

namespace saccade {

/// Calls `call(task)` as on_openni2_thread() does.
void run_on_openni2_thread(void (*call)(void* task), void* task);

/// Runs `task` on the one thread of this process that uses OpenNI2, after those that came before, and returns
/// when it is done. OpenNI2 remembers each thread that has ever called it, for its messages, and asks by
/// pthread_kill() whether they still live when another calls it for the first time: of a thread that has
/// ended that is a crash. So no thread that ends may call it, and this one never ends. Any thread, this one
/// too. What `task` throws comes out here. Allocates nothing: frames are read in this way.
template <typename Task>
void on_openni2_thread(Task&& task) {
  using T = std::remove_reference_t<Task>;
  run_on_openni2_thread([](void* t) { (*static_cast<T*>(t))(); }, std::addressof(task));
}

}  // namespace saccade
