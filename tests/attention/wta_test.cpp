#include "attention/wta.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wta_reference.hpp"

namespace saccade {
namespace {

using testing::HasSubstr;

const Intrinsics kCamera{525, 525, 319.5, 239.5, IntrinsicsOrigin::guess};

cv::Mat1f peaks(cv::Size size, const std::vector<std::pair<cv::Point, float>>& list) {
  cv::Mat1f map(size, 0.0F);
  for (const auto& [at, value] : list) map(at) = value;
  return map;
}

cv::Mat1f random_map(cv::Size size, unsigned seed, double power) {
  std::mt19937 random(seed);
  cv::Mat1f map(size);
  for (float& value : map)
    value = static_cast<float>(std::pow(static_cast<double>(random()) / std::mt19937::max(), power));
  map(size.height / 2, size.width / 3) = 1;
  return map;
}

// The winners that the network gives out: those of the reference without repetitions.
void expect_as_reference(const cv::Mat1f& map, double foa_px, int count) {
  WtaNetwork network;
  network.reset(map, foa_px);
  std::vector<WtaNetwork::Winner> given;
  while (static_cast<int>(given.size()) < count) {
    const auto winner = network.next();
    if (!winner) break;
    given.push_back(*winner);
  }
  ASSERT_FALSE(given.empty());
  const auto all = reference_winners(map, foa_px, given.back().step);
  std::set<std::pair<int, int>> seen;
  std::size_t k = 0;
  for (const auto& winner : all) {
    if (!seen.insert({winner.row, winner.col}).second) continue;
    ASSERT_LT(k, given.size());
    EXPECT_EQ(given[k].row, winner.row) << "winner " << k;
    EXPECT_EQ(given[k].col, winner.col) << "winner " << k;
    EXPECT_EQ(given[k].step, winner.step) << "winner " << k;
    ++k;
  }
  EXPECT_EQ(k, given.size());
}

TEST(WtaNetwork, WinsTheSameCellsInTheSameStepsAsTheDirectSimulation) {
  expect_as_reference(random_map({12, 9}, 1, 1), 64, 20);
  expect_as_reference(random_map({20, 15}, 2, 4), 64, 20);
  expect_as_reference(random_map({13, 7}, 3, 8), 30, 30);
  expect_as_reference(random_map({5, 16}, 4, 2), 200, 10);
  expect_as_reference(cv::Mat1f(6, 8, 1.0F), 64, 10);
}

TEST(WtaNetwork, InhibitionOfReturnMovesFromThePeakToTheNext) {
  WtaNetwork network;
  network.reset(peaks({40, 30}, {{{5, 6}, 0.6F}, {{30, 20}, 1.0F}, {{20, 3}, 0.8F}}), 64);
  std::vector<cv::Point> order;
  int last = 0;
  while (const auto winner = network.next()) {
    EXPECT_GT(winner->step, last);
    last = winner->step;
    order.emplace_back(winner->col, winner->row);
  }
  EXPECT_EQ(order, (std::vector<cv::Point>{{30, 20}, {20, 3}, {5, 6}}));
  EXPECT_THAT(network.ended(), HasSubstr("no further cell"));
}

TEST(WtaNetwork, TiesGoToTheLowestColumnThenTheLowestRow) {
  WtaNetwork network;
  network.reset(peaks({40, 30}, {{{30, 2}, 1.0F}, {{10, 25}, 1.0F}, {{10, 8}, 1.0F}}), 64);
  const auto winner = network.next();
  ASSERT_TRUE(winner);
  EXPECT_EQ(winner->row, 8);
  EXPECT_EQ(winner->col, 10);
}

TEST(WtaNetwork, AFlatMapFiresByTiesAndGivesEveryCellAtMostOnce) {
  WtaNetwork network;
  network.reset(cv::Mat1f(4, 5, 1.0F), 64);
  std::set<std::pair<int, int>> seen;
  while (const auto winner = network.next()) {
    if (seen.empty()) {
      EXPECT_TRUE(winner->row == 0 && winner->col == 0);
    }
    EXPECT_TRUE(seen.insert({winner->row, winner->col}).second);
  }
  EXPECT_GT(seen.size(), 1U);
  EXPECT_FALSE(network.ended().empty());
}

TEST(WtaNetwork, ANeuronBelowTheThresholdEndsIt) {
  // 0.02 of the maximum drives a cell to 1 mV in the limit, so 0.019 never fires.
  WtaNetwork network;
  network.reset(peaks({30, 30}, {{{3, 3}, 1.0F}, {{25, 25}, 0.019F}}), 64);
  EXPECT_TRUE(network.next());
  EXPECT_FALSE(network.next());
  EXPECT_THAT(network.ended(), HasSubstr("threshold"));
}

TEST(WtaNetwork, AnEmptyMapEndsAtOnce) {
  WtaNetwork network;
  network.reset(cv::Mat1f(30, 40, 0.0F), 64);
  EXPECT_FALSE(network.next());
  EXPECT_THAT(network.ended(), HasSubstr("empty"));
  EXPECT_THROW(network.reset(cv::Mat1f(), 64), std::invalid_argument);
}

TEST(ReduceToCells, IsTheMeanOfEachCellOverTheLargest) {
  cv::Mat1f map(20, 33, 0.0F), cells;
  map(cv::Rect(0, 0, 16, 16)) = 1.0F;
  map(cv::Rect(32, 16, 1, 4)) = 4.0F;
  map(cv::Rect(16, 0, 8, 16)) = 2.0F;
  reduce_to_cells(map, cells);
  ASSERT_EQ(cells.size(), cv::Size(3, 2));
  EXPECT_EQ(cells(0, 0), 0.25F);
  EXPECT_EQ(cells(0, 1), 0.25F);
  EXPECT_EQ(cells(1, 2), 1.0F);
  EXPECT_EQ(cells(1, 0), 0.0F);
}

TEST(WtaSelector, FixatesTheMiddleOfTheCellsClampedIntoTheImage) {
  cv::Mat1f saliency(40, 36, 0.0F), depth(40, 36, 1000.0F);
  saliency(39, 35) = 3;
  saliency(5, 5) = 1;
  depth(8, 8) = 0;
  WtaSelector selector(5, 64);
  Attention attention;
  selector.select(saliency, depth, kCamera, attention);
  ASSERT_EQ(attention.fixations.size(), 2U);
  EXPECT_EQ(attention.fixations[0].row, 39);
  EXPECT_EQ(attention.fixations[0].col, 35);
  EXPECT_EQ(attention.fixations[0].saliency, 3);
  EXPECT_EQ(attention.fixations[0].position_mm.z, 1000);
  EXPECT_EQ(attention.fixations[1].row, 8);
  EXPECT_EQ(attention.fixations[1].col, 8);
  EXPECT_EQ(attention.fixations[1].position_mm, cv::Point3f());
  EXPECT_FALSE(attention.ended_early.empty());
  EXPECT_EQ(cv::countNonZero(attention.masks), 0);
}

TEST(WtaSelector, RefusesWhatItCannotUse) {
  EXPECT_THROW(WtaSelector(0, 64), std::invalid_argument);
  EXPECT_THROW(WtaSelector(1, 0), std::invalid_argument);
  EXPECT_THROW(WtaSelector(1, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  WtaSelector selector(1, 64);
  Attention attention;
  EXPECT_THROW(selector.select(cv::Mat1f(), cv::Mat1f(), kCamera, attention), std::invalid_argument);
  EXPECT_THROW(selector.select(cv::Mat1f(8, 8, 0.0F), cv::Mat1f(8, 9, 0.0F), kCamera, attention),
               std::invalid_argument);
  EXPECT_THROW(selector.select(cv::Mat1f(8, 8, 0.0F), cv::Mat1f(8, 8, 0.0F), Intrinsics{}, attention),
               std::invalid_argument);
}

}  // namespace
}  // namespace saccade
