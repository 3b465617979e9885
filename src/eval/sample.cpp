#include "eval/sample.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saccade {

void Moments::add(const std::vector<double>& row) {
  sum.resize(row.size());
  squares.resize(row.size());
  ++rows;
  for (std::size_t n = 0; n < row.size(); ++n) {
    sum[n] += row[n];
    squares[n] += row[n] * row[n];
  }
}

Moments operator+(Moments a, const Moments& b) {
  a.rows += b.rows;
  for (std::size_t n = 0; n < b.sum.size(); ++n) {
    a.sum[n] += b.sum[n];
    a.squares[n] += b.squares[n];
  }
  return a;
}

std::vector<double> Moments::mean() const {
  std::vector<double> mean = sum;
  for (double& value : mean) value /= static_cast<double>(rows);
  return mean;
}

std::vector<Interval> Moments::normal_95() const {
  constexpr double kQuantile = 1.959963984540054;  // 97.5 % of the standard normal distribution
  const auto count = static_cast<double>(rows);
  std::vector<Interval> intervals;
  for (std::size_t n = 0; n < sum.size(); ++n) {
    const double mean = sum[n] / count;
    const double variance = std::max(0.0, (squares[n] - mean * sum[n]) / (count - 1));
    const double half = kQuantile * std::sqrt(variance / count);
    intervals.push_back({mean - half, mean + half});
  }
  return intervals;
}

void Sample::add(std::vector<double> row) {
  halves_[all_.rows % 2].add(row);
  all_.add(row);
  if (is_kept())
    rows_.push_back(std::move(row));
  else
    Table().swap(rows_);
}

Curve curve_of(const Sample& sample) {
  return sample.is_kept() ? curve_of(sample.rows(), resampled(sample.rows())) : curve_of(sample.all());
}

Curve curve_of(const Table& rows, const Table& resampled) {
  Curve curve{column_means(rows), {}};
  for (std::size_t n = 0; n < curve.mean.size(); ++n)
    curve.interval.push_back(central_95(column(resampled, n)));
  return curve;
}

Table resampled(const Table& rows) { return resampled_means(rows, kResamples, kBootstrapSeed); }

Curve curve_of(const Moments& moments) { return {moments.mean(), moments.normal_95()}; }

}  // namespace saccade
