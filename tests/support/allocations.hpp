#pragma once

#include <cstdint>

namespace saccade {

/// How often operator new was called so far, in a program that allocations.cpp is linked to: by all threads,
/// and by the calling one. Images count too, since cv::Mat allocates the header of its pixels by it.
std::int64_t allocations();
std::int64_t allocations_of_this_thread();

}  // namespace saccade
