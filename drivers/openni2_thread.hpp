#pragma once

#include <functional>

namespace saccade {

/// Runs `task` on the one thread of this process that uses OpenNI2, after those that came before, and returns
/// when it is done. OpenNI2 remembers each thread that has ever called it, for its messages, and asks by
/// pthread_kill() whether they still live when another calls it for the first time: of a thread that has
/// ended that is a crash. So no thread that ends may call it, and this one never ends. Any thread, this one
/// too. What `task` throws comes out here.
void on_openni2_thread(const std::function<void()>& task);

}  // namespace saccade
