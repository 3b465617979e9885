#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace saccade {

/// One row per image, one column per number of points.
using Table = std::vector<std::vector<double>>;

struct Interval {
  double low = 0, high = 0;
};

/// The n-th number of each row.
[[nodiscard]] std::vector<double> column(const Table& table, std::size_t n);

/// The mean of each column.
std::vector<double> column_means(const Table& table);

/// The column means of `resamples` bootstrap samples, one row per sample; a sample draws as many rows as the
/// table has, with replacement. The rows of a sample depend on the seed and the number of rows alone, so that
/// the difference between the means of two tables is that of a paired bootstrap. Throws std::invalid_argument
/// if there are no rows, or rows of different lengths.
Table resampled_means(const Table& table, int resamples, std::uint64_t seed);

/// The central 95 % of the values (percentile method, linear between order statistics).
/// Throws std::invalid_argument if there are none.
Interval central_95(std::vector<double> values);

}  // namespace saccade
