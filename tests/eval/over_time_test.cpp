#include "eval/over_time.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace saccade {
namespace {

const Intrinsics kCamera{525, 525, 319.5, 239.5, IntrinsicsOrigin::sensor};

WatchedFrame frame_with(std::vector<WatchedFrame::Point> points, std::vector<int> labels = {}) {
  WatchedFrame frame;
  frame.points = std::move(points);
  frame.labels = std::move(labels);
  frame.camera_to_world = cv::Affine3d::Identity();
  frame.camera = kCamera;
  frame.size = {640, 480};
  return frame;
}

WatchedFrame::Point at(int id, double x_mm, int label = 0) { return {id, label, {x_mm, 0, 1000}}; }

TEST(OverTime, WhatStaysIsHeld) {
  std::vector<WatchedFrame> frames(40, frame_with({at(1, 0), at(2, 200)}));
  const OverTime result = measure_over_time(frames);
  for (std::size_t i = 0; i < OverTime::kFirst.size(); ++i) {
    EXPECT_EQ(result.held_next[i], 1);
    EXPECT_EQ(result.held_later[i], 1);
  }
  EXPECT_EQ(result.first_stays, 1);
  EXPECT_EQ(result.ids_per_place, 1);
  EXPECT_FALSE(result.identity_f1);
}

TEST(OverTime, AnotherIdOrPlaceIsNotHeld) {
  const WatchedFrame a = frame_with({at(1, 0), at(2, 200)}), other_id = frame_with({at(3, 0), at(2, 200)}),
                     other_place = frame_with({at(1, 81), at(2, 200)});
  EXPECT_EQ(measure_over_time({a, other_id}).held_next[1], 0.5);
  EXPECT_EQ(measure_over_time({a, other_id}).first_stays, 0);
  EXPECT_EQ(measure_over_time({a, other_place}).held_next[1], 0.5);
  EXPECT_EQ(measure_over_time({a, other_place}).held_next[0], 0);
  EXPECT_FALSE(measure_over_time({a, a}).held_later[0]) << "too short";
}

TEST(OverTime, PlacesAreInTheWorldAndOnlyThoseInViewCount) {
  WatchedFrame before = frame_with({at(1, 0), at(2, 500)}), after = frame_with({at(1, -200)});
  after.camera_to_world = cv::Affine3d(cv::Matx33d::eye(), cv::Vec3d(200, 0, 0));
  EXPECT_EQ(measure_over_time({before, after}).held_next[2], 0.5) << "2 is in view still";
  after.camera_to_world = cv::Affine3d(cv::Matx33d::eye(), cv::Vec3d(-300, 0, 0));
  after.points = {at(1, 300)};
  EXPECT_EQ(measure_over_time({before, after}).held_next[2], 1) << "2 is out of view";
  after.camera_to_world.reset();
  EXPECT_FALSE(measure_over_time({before, after}).held_next[2]) << "poses must be known";
}

TEST(OverTime, IdsPerPlaceCountsNewNumbersOfOldPlaces) {
  std::vector<WatchedFrame> frames;
  for (int k = 0; k < 20; ++k)
    frames.push_back(frame_with({at(k < 10 ? 1 : 5, 0), at(2, 300), at(100 + k, 900)}));
  EXPECT_EQ(measure_over_time(frames).ids_per_place, 1.5)
      << "1, 5 and 2 at two places; the rest was too short";
}

TEST(OverTime, IdentityF1AndSwitches) {
  std::vector<WatchedFrame> frames(10, frame_with({at(1, 0, 7), at(2, 300, 8)}, {7, 8}));
  EXPECT_EQ(measure_over_time(frames).identity_f1, 1);
  EXPECT_EQ(measure_over_time(frames).id_switches, 0);
  for (std::size_t k = 5; k < 10; ++k) frames[k].points[0].id = 9;
  EXPECT_DOUBLE_EQ(*measure_over_time(frames).identity_f1, 2.0 * 15 / 40)
      << "1 or 9 is right in 5 of 10 frames";
  EXPECT_EQ(measure_over_time(frames).id_switches, 1);
  for (WatchedFrame& frame : frames) frame.points.push_back(at(3, 600, 0));
  EXPECT_DOUBLE_EQ(*measure_over_time(frames).identity_f1, 2.0 * 15 / 40);
  EXPECT_DOUBLE_EQ(*measure_over_time(frames).identity_f1_all, 2.0 * 15 / 50)
      << "a point on nothing is wrong";
  for (WatchedFrame& frame : frames) frame.points.clear();
  EXPECT_EQ(measure_over_time(frames).identity_f1, 0);
}

// Labels 7, 8 and 9: 7 has points under two ids, one of them in most frames; 8 lies in the mask of a point on
// 7; 9 has no point.
TEST(OverTime, WhereIdentityIsLost) {
  WatchedFrame frame = frame_with({at(1, 0, 7), at(2, 100, 7), at(3, 900, 0)}, {7, 8, 9});
  frame.covered_by = {0, 1, -1};
  std::vector<WatchedFrame> frames(10, frame);
  for (std::size_t k = 0; k < 3; ++k) {
    frames[k].points = {at(4, 0, 7), at(3, 900, 0)};
    frames[k].covered_by = {0, 0, -1};
  }
  const OverTime result = measure_over_time(frames);
  ASSERT_EQ(result.of_label.size(), 3U);
  const IdentityCounts &a = result.of_label.at(7), &b = result.of_label.at(8), &c = result.of_label.at(9);
  EXPECT_EQ(a.in_view, 10);
  EXPECT_EQ(a.right, 7);
  EXPECT_EQ(a.other_id, 3);
  EXPECT_EQ(a.more_points, 7);
  EXPECT_EQ(b.in_other, 10);
  EXPECT_EQ(c.without, 10);
  EXPECT_EQ(result.points_on_nothing, 10);
  IdentityCounts all;
  for (const auto& [label, counts] : result.of_label) all += counts;
  EXPECT_EQ(all.in_view, all.right + all.other_id + all.in_other + all.without);
  EXPECT_DOUBLE_EQ(*result.identity_f1,
                   2.0 * all.right / (all.in_view + all.right + all.other_id + all.more_points));
}

// Two of three objects have points in each frame, one of them a second point: what ids cost is not counted.
TEST(OverTime, WithPerfectIdsOnlyTheChoiceOfPointsCounts) {
  std::vector<WatchedFrame> frames;
  for (int k = 0; k < 10; ++k)
    frames.push_back(frame_with(
        {at(3 * k + 1, 0, 7), at(3 * k + 2, 100, 7), at(3 * k + 3, 300, 8), at(99, 900, 0)}, {7, 8, 9}));
  EXPECT_DOUBLE_EQ(*best_identity_f1(frames), 2.0 * 2 / (3 + 3));
  EXPECT_EQ(measure_over_time(frames).best_identity_f1, best_identity_f1(frames));
  EXPECT_LT(*measure_over_time(frames).identity_f1, 0.1) << "each id is right in one frame";
  EXPECT_FALSE(best_identity_f1({frame_with({at(1, 0)})})) << "no object is in view";
}

// Two objects side by side, of which a mask covers one whole and a third of the other.
TEST(WatchedFrame, KnowsWhichMaskCoversAnObject) {
  Frame frame;
  frame.truth.labels = cv::Mat1w(40, 60, static_cast<ushort>(0));
  frame.truth.labels(cv::Rect(0, 0, 30, 40)) = 5;
  frame.truth.labels(cv::Rect(30, 0, 30, 40)) = 6;
  frame.depth_mm = cv::Mat1f(40, 60, 1000.0F);
  Attention attention;
  attention.fixations.resize(2);
  attention.fixations[1].col = 59;
  attention.masks = cv::Mat1w(40, 60, static_cast<ushort>(0));
  attention.masks(cv::Rect(0, 0, 40, 40)) = 2;
  const WatchedFrame watched = watched_frame(frame, attention);
  EXPECT_EQ(watched.labels, (std::vector<int>{5, 6}));
  EXPECT_EQ(watched.covered_by, (std::vector<int>{1, -1}));
}

// All permutations of the columns.
double slow_best(const cv::Mat1d& gain) {
  std::vector<int> columns(static_cast<std::size_t>(std::max(gain.rows, gain.cols)));
  std::iota(columns.begin(), columns.end(), 0);
  double best = 0;
  do {
    double sum = 0;
    for (int row = 0; row < gain.rows; ++row)
      if (const int col = columns[static_cast<std::size_t>(row)]; col < gain.cols) sum += gain(row, col);
    best = std::max(best, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return best;
}

TEST(BestAssignment, IsTheBestOfAll) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const int rows = 1 + trial % 6, cols = 1 + trial / 6 % 6;
    cv::Mat1d gain(rows, cols);
    for (double& value : gain) value = static_cast<double>(random() % 20);
    const std::vector<int> column = best_assignment(gain);
    double sum = 0;
    std::vector<int> used;
    for (int row = 0; row < rows; ++row)
      if (const int col = column[static_cast<std::size_t>(row)]; col >= 0) {
        EXPECT_EQ(std::count(used.begin(), used.end(), col), 0);
        used.push_back(col);
        sum += gain(row, col);
      }
    EXPECT_EQ(static_cast<int>(used.size()), std::min(rows, cols));
    EXPECT_EQ(sum, slow_best(gain)) << gain;
  }
}

}  // namespace
}  // namespace saccade
