#pragma once

#include <algorithm>
#include <functional>

#include <opencv2/core.hpp>

#include "core/frame.hpp"
#include "core/worker_pool.hpp"

namespace saccade {

/// The frame's colour image. Throws Error (unreadable) that names `model` if the frame has none.
const cv::Mat3b& colour_of(const Frame& frame, const char* model);

/// Shares rows 0..rows among the workers in bands that are the same for any number of them: job(begin, end).
template <typename Job>
void for_row_bands(WorkerPool& pool, int rows, Job job) {
  constexpr int kRows = 16;
  const auto band = [&](int b, int) { job(b * kRows, std::min((b + 1) * kRows, rows)); };
  pool.for_each((rows + kRows - 1) / kRows, std::ref(band));
}

/// Rows begin..end of `fine` get (with `add`: on top of what they hold) `coarse`, which is `levels` >= 0
/// pyramid levels above, interpolated bilinearly at (r/2^levels, c/2^levels) and clamped at the border: a
/// level holds the even pixels of the one below.
void upsample_rows(const cv::Mat1f& coarse, int levels, cv::Mat1f& fine, bool add, int begin, int end);

}  // namespace saccade
