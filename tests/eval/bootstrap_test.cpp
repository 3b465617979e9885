#include "eval/bootstrap.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/random.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;

constexpr int kSamples = 2000;

std::vector<double> first_column(const Table& table) {
  std::vector<double> values;
  for (const auto& row : table) values.push_back(row[0]);
  return values;
}

Table uniform_table(std::size_t rows) {
  Table table;
  for (std::uint64_t i = 0; i < rows; ++i) table.push_back({scene::uniform(scene::mix(77, i))});
  return table;
}

TEST(Bootstrap, MeansOfColumns) {
  EXPECT_THAT(column_means({{1, 10}, {2, 30}, {6, 20}}), ElementsAre(3, 20));
  EXPECT_THROW(column_means({}), std::invalid_argument);
  EXPECT_THROW(column_means({{1, 2}, {3}}), std::invalid_argument);
}

TEST(Bootstrap, EqualValuesHaveNoSpread) {
  const Interval interval = central_95(first_column(resampled_means(Table(9, {0.25}), kSamples, 1)));
  EXPECT_EQ(interval.low, 0.25);
  EXPECT_EQ(interval.high, 0.25);
}

TEST(Bootstrap, IntervalIsThatOfTheNormalApproximation) {
  const Table table = uniform_table(400);
  const double mean = column_means(table)[0];
  double variance = 0;
  for (const auto& row : table) variance += (row[0] - mean) * (row[0] - mean) / 399;
  const double half = 1.96 * std::sqrt(variance / 400);
  const Interval interval = central_95(first_column(resampled_means(table, kSamples, 1)));
  EXPECT_NEAR(interval.low, mean - half, 0.1 * half);
  EXPECT_NEAR(interval.high, mean + half, 0.1 * half);
}

TEST(Bootstrap, IntervalsCoverTheTrueMean) {
  constexpr int kTrials = 200;
  int covered = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Table table;
    for (std::uint64_t i = 0; i < 40; ++i)
      table.push_back({scene::uniform(scene::mix(scene::mix(5, trial), i))});
    const Interval interval = central_95(first_column(resampled_means(table, 400, trial)));
    covered += interval.low <= 0.5 && 0.5 <= interval.high;
  }
  EXPECT_GE(covered, 0.90 * kTrials);
  EXPECT_LE(covered, 0.985 * kTrials);
}

TEST(Bootstrap, SamplesAreOfRowsWithReplacement) {
  // Rows of one 1 each: a sample's means are the shares of the rows in it.
  const Table samples = resampled_means({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, kSamples, 3);
  int all_different = 0;
  for (const auto& shares : samples) {
    EXPECT_NEAR(shares[0] + shares[1] + shares[2], 1, 1e-12);
    for (const double share : shares) EXPECT_NEAR(share * 3, std::round(share * 3), 1e-12);
    all_different += shares[0] > 0 && shares[1] > 0 && shares[2] > 0;
  }
  EXPECT_NEAR(all_different / static_cast<double>(kSamples), 6.0 / 27, 0.03);
}

TEST(Bootstrap, SameSeedSameSamples) {
  const Table table = uniform_table(20);
  EXPECT_EQ(resampled_means(table, 50, 4), resampled_means(table, 50, 4));
  EXPECT_NE(resampled_means(table, 50, 4), resampled_means(table, 50, 5));
}

TEST(Bootstrap, TablesOfOneSizeArePaired) {
  const Table a = uniform_table(20);
  Table b = a;
  for (auto& row : b) row[0] += 0.125;
  const Table of_a = resampled_means(a, kSamples, 1), of_b = resampled_means(b, kSamples, 1);
  for (std::size_t i = 0; i < of_a.size(); ++i) EXPECT_NEAR(of_b[i][0] - of_a[i][0], 0.125, 1e-12);
}

TEST(Bootstrap, QuantilesBetweenOrderStatistics) {
  std::vector<double> values;
  for (int i = 1000; i >= 0; --i) values.push_back(i);
  EXPECT_NEAR(central_95(values).low, 25, 1e-9);
  EXPECT_NEAR(central_95(values).high, 975, 1e-9);
  EXPECT_NEAR(central_95({0, 1}).low, 0.025, 1e-12);
  EXPECT_EQ(central_95({3}).high, 3);
  EXPECT_THROW(central_95({}), std::invalid_argument);
}

}  // namespace
}  // namespace saccade
