#pragma once

#include <cstdint>
#include <vector>

namespace saccade {

/// One row per image, one column per number of points.
using Table = std::vector<std::vector<double>>;

struct Interval {
  double low = 0, high = 0;
};

/// The mean of each column.
std::vector<double> column_means(const Table& table);

/// The column means of `resamples` bootstrap samples: each draws as many rows as there are, with replacement.
/// Which rows a sample holds depends on the seed and the number of rows alone, so that the differences
/// between two tables' means are those of a paired bootstrap. One row per sample. The rows must be of one
/// length, and there must be any: std::invalid_argument.
Table resampled_means(const Table& table, int resamples, std::uint64_t seed);

/// The central 95 % of the values (percentile method, linear between order statistics).
/// Throws std::invalid_argument if there are none.
Interval central_95(std::vector<double> values);

}  // namespace saccade
