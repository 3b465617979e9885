#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "eval/bootstrap.hpp"

namespace saccade {

/// The rows of so many images are kept and resampled. The mean of more independent rows is normally
/// distributed, so that its interval follows from sums over the rows.
inline constexpr std::size_t kMostResampled = 10'000;
inline constexpr int kResamples = 2000;
inline constexpr std::uint64_t kBootstrapSeed = 1;

/// Means over images, n = 1..points, with their 95 % intervals.
struct Curve {
  std::vector<double> mean;
  std::vector<Interval> interval;
};

/// Sums over rows of one length and over their squares.
struct Moments {
  std::size_t rows = 0;
  std::vector<double> sum, squares;

  void add(const std::vector<double>& row);
  friend Moments operator+(Moments a, const Moments& b);

  std::vector<double> mean() const;
  /// The central 95 % of a normal distribution with the mean's standard error. Needs 2 rows.
  std::vector<Interval> normal_95() const;
};

/// One row per image, added in the order of the images. Needs memory for kMostResampled rows at most.
class Sample {
 public:
  void add(std::vector<double> row);

  std::size_t size() const { return all_.rows; }
  /// Whether all rows are there, as rows().
  bool is_kept() const { return size() <= kMostResampled; }
  const Table& rows() const { return rows_; }

  const Moments& all() const { return all_; }
  /// Of the rows 0, 2, 4, .. and 1, 3, 5, ..
  const std::array<Moments, 2>& halves() const { return halves_; }

 private:
  Table rows_;
  Moments all_;
  std::array<Moments, 2> halves_;
};

/// Of kept rows by bootstrap, of others by their moments.
[[nodiscard]] Curve curve_of(const Sample& sample);

/// By bootstrap: `resampled` are resampled_means() of the rows.
[[nodiscard]] Curve curve_of(const Table& rows, const Table& resampled);
[[nodiscard]] Table resampled(const Table& rows);

[[nodiscard]] Curve curve_of(const Moments& moments);

}  // namespace saccade
