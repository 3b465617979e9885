#include "ui/session/object_numbers.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace saccade {
namespace {

// A frame of one side: its objects are columns of the image, by their left and right borders.
struct Side {
  std::map<int, int> numbers{};
  std::vector<int> ids{};
  Attention attention{};

  Side& see(const std::vector<std::pair<int, cv::Range>>& objects) {
    ids.clear();
    attention.fixations.clear();
    attention.masks = cv::Mat1w::zeros(10, 100);
    for (const auto& [id, columns] : objects) {
      ids.push_back(id);
      attention.fixations.emplace_back();
      attention.masks.colRange(columns).setTo(static_cast<int>(ids.size()));
    }
    return *this;
  }

  std::vector<int> shown() const {
    std::vector<int> shown;
    for (const int id : ids) shown.push_back(numbers.at(id));
    return shown;
  }
};

const cv::Range kLeft{0, 30}, kMiddle{35, 65}, kRight{70, 100};

class ObjectNumbersTest : public ::testing::Test {
 protected:
  void assign() {
    const NumberedSide b{b_.numbers, b_.ids, b_.attention};
    assign_numbers({a_.numbers, a_.ids, a_.attention}, &b, used_);
  }

  Side a_, b_;
  UsedNumbers used_;
};

TEST_F(ObjectNumbersTest, ASideThatStandsAloneHasItsIds) {
  a_.see({{2, kLeft}, {7, kMiddle}});
  assign_numbers({a_.numbers, a_.ids, a_.attention}, nullptr, used_);
  EXPECT_EQ(a_.shown(), (std::vector{2, 7}));
  a_.see({{4, kRight}, {7, kMiddle}});  // first reported after a younger one
  assign_numbers({a_.numbers, a_.ids, a_.attention}, nullptr, used_);
  EXPECT_EQ(a_.shown(), (std::vector{4, 7}));
  EXPECT_EQ(used_.next(), 8);
}

TEST_F(ObjectNumbersTest, TheSameThingHasOneNumberWhateverItsRank) {
  a_.see({{1, kLeft}, {2, kMiddle}, {3, kRight}});
  b_.see({{1, kMiddle}, {2, kRight}, {3, kLeft}});
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1, 2, 3}));
  EXPECT_EQ(b_.shown(), (std::vector{2, 3, 1}));
}

TEST_F(ObjectNumbersTest, MoreThanHalfOfTheUnionMustBeInBoth) {
  a_.see({{1, {0, 40}}, {2, {60, 100}}});
  b_.see({{1, {70, 80}}, {2, {10, 40}}});  // a quarter of A's 2; three quarters of A's 1
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1, 2}));
  EXPECT_EQ(b_.shown(), (std::vector{3, 1}));
}

TEST_F(ObjectNumbersTest, WhatOneSideFindsLaterHasTheNumberThatTheOtherGaveIt) {
  a_.see({{1, kLeft}});
  b_.see({{1, kLeft}, {2, kRight}});
  assign();
  EXPECT_EQ(b_.shown(), (std::vector{1, 2}));
  a_.see({{1, kLeft}, {2, kMiddle}});
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1, 3})) << "2 is on B's side another thing";
  a_.see({{1, kLeft}, {2, kMiddle}, {3, kRight}});
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1, 3, 2}));
  EXPECT_EQ(b_.shown(), (std::vector{1, 2}));
}

TEST_F(ObjectNumbersTest, WhereBothKnowItByDifferentNumbersAsNumberHolds) {
  a_.see({{1, kLeft}});
  b_.see({{2, kRight}, {1, kMiddle}});
  assign();
  EXPECT_EQ(b_.shown(), (std::vector{2, 3}));
  a_.see({{1, kRight}});  // it has moved
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1}));
  EXPECT_EQ(b_.shown(), (std::vector{1, 3}));
}

TEST_F(ObjectNumbersTest, NoTwoObjectsOfASideHaveOneNumber) {
  a_.see({{1, kLeft}});
  b_.see({{1, kLeft}});
  assign();
  a_.see({{1, kRight}});
  b_.see({{1, kLeft}, {2, kRight}});  // B has lost it: its 2 is what A calls 1
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1}));
  EXPECT_EQ(b_.shown(), (std::vector{2, 1}));
}

TEST_F(ObjectNumbersTest, NumbersStayWhereTheObjectsNoLongerMatch) {
  a_.see({{1, kLeft}, {2, kRight}});
  b_.see({{1, kRight}, {2, kLeft}});
  assign();
  b_.see({{1, {95, 100}}, {2, {0, 5}}});  // only a part of each is seen
  assign();
  EXPECT_EQ(a_.shown(), (std::vector{1, 2}));
  EXPECT_EQ(b_.shown(), (std::vector{2, 1}));
}

}  // namespace
}  // namespace saccade
