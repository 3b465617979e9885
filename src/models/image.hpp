#pragma once

#include <algorithm>
#include <functional>

#include <opencv2/core.hpp>

#include "core/frame.hpp"
#include "core/worker_pool.hpp"

namespace saccade {

/// The frame's colour image. Throws Error (unreadable) that names `model` if the frame has none.
const cv::Mat3b& colour_of(const Frame& frame, const char* model);

/// Divides rows 0..rows among the workers: job(begin, end). The bands are the same for any number of workers.
template <typename Job>
void for_row_bands(WorkerPool& pool, int rows, Job job) {
  constexpr int kRows = 16;
  const auto band = [&](int b, int) { job(b * kRows, std::min((b + 1) * kRows, rows)); };
  pool.for_each((rows + kRows - 1) / kRows, std::ref(band));
}

/// Interpolates `coarse`, which is `levels` >= 0 pyramid levels above `fine`, into rows begin..end of `fine`,
/// or with `add` adds it to them. Bilinear at (r/2^levels, c/2^levels) and clamped at the border, since a
/// level holds the even pixels of the one below.
void upsample_rows(const cv::Mat1f& coarse, int levels, cv::Mat1f& fine, bool add, int begin, int end);

}  // namespace saccade
