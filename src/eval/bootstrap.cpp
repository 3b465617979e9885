#include "eval/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/random.hpp"

namespace saccade {
namespace {

void add_row(std::vector<double>& sum, const std::vector<double>& row) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += row[i];
}

void check_table(const Table& table) {
  if (table.empty()) throw std::invalid_argument("bootstrap: no rows");
  for (const auto& row : table)
    if (row.size() != table[0].size()) throw std::invalid_argument("bootstrap: rows of different lengths");
}

}  // namespace

std::vector<double> column(const Table& table, std::size_t n) {
  std::vector<double> values;
  for (const auto& row : table) values.push_back(row[n]);
  return values;
}

std::vector<double> column_means(const Table& table) {
  check_table(table);
  std::vector<double> mean(table[0].size());
  for (const auto& row : table) add_row(mean, row);
  for (double& value : mean) value /= static_cast<double>(table.size());
  return mean;
}

Table resampled_means(const Table& table, int resamples, std::uint64_t seed) {
  check_table(table);
  const auto rows = static_cast<double>(table.size());
  Table means;
  for (int b = 0; b < resamples; ++b) {
    const std::uint64_t key = scene::mix(seed, static_cast<std::uint64_t>(b));
    std::vector<double> mean(table[0].size());
    for (std::uint64_t i = 0; i < table.size(); ++i)
      add_row(mean, table[static_cast<std::size_t>(scene::uniform(scene::mix(key, i)) * rows)]);
    for (double& value : mean) value /= rows;
    means.push_back(std::move(mean));
  }
  return means;
}

Interval central_95(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("central_95: no values");
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double q) {
    const double position = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (position - std::floor(position)) * (values[above] - values[below]);
  };
  return {quantile(0.025), quantile(0.975)};
}

}  // namespace saccade
