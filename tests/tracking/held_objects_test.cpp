// What hangs in the air above a narrower thing is held by it.
#include "tracking/held_objects.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

// 320 x 240 pixels, 80 x 60 cells: a wall at 3 m, and things before it at 1.5 m unless a test says otherwise.
// Places are in cells.
class HeldObjectsTest : public ::testing::Test {
 protected:
  static constexpr int kCols = 80, kRows = 60;
  static constexpr float kWall_mm = 3000, kThing_mm = 1500;

  HeldObjectsTest() : depth_(kRows * 4, kCols * 4, kWall_mm), object_of_(kRows * kCols, -1) {}

  int add(const cv::Rect& place, float depth_mm = kThing_mm) {
    extend(objects_, place, depth_mm);
    return objects_++;
  }

  void extend(int object, const cv::Rect& place, float depth_mm = kThing_mm) {
    paint(place, depth_mm);
    for (int row = place.y; row < place.br().y; ++row)
      for (int col = place.x; col < place.br().x; ++col) object_of_[at(row * kCols + col)] = object;
  }

  void paint(const cv::Rect& place, float depth_mm) {
    depth_({4 * place.x, 4 * place.y, 4 * place.width, 4 * place.height}) = depth_mm;
  }

  // Pairs of what is held and what holds it.
  std::vector<std::pair<int, int>> find() {
    SurfaceGrid grid;
    grid.build(depth_, Intrinsics::guess_for(depth_.size()));
    std::vector<std::pair<int, int>> pairs;
    for (const HeldObjects::Pair& pair : held_.find(grid, object_of_, objects_))
      pairs.emplace_back(pair.held, pair.holder);
    return pairs;
  }

  using Pairs = std::vector<std::pair<int, int>>;

  cv::Mat1f depth_;
  std::vector<int> object_of_;
  int objects_ = 0;
  HeldObjects held_;
};

const cv::Rect kShade{30, 10, 20, 10}, kPole{39, 20, 2, 25};

// The pole is at the depth of the sides of the shade, which is round.
TEST_F(HeldObjectsTest, AShadeIsHeldByItsPole) {
  const int shade = add(kShade), pole = add(kPole, 1600);
  extend(shade, {30, 10, 2, 10}, 1600);
  EXPECT_EQ(find(), (Pairs{{shade, pole}}));
}

TEST_F(HeldObjectsTest, ATableTopIsHeldByEachLeg) {
  const int left = add({20, 30, 2, 15}), top = add({18, 26, 40, 4}), right = add({54, 30, 2, 15});
  EXPECT_EQ(find(), (Pairs{{top, left}, {top, right}}));
}

TEST_F(HeldObjectsTest, TwoCellsMayBeBetween) {
  const int shade = add(kShade), pole = add({39, 22, 2, 23});
  EXPECT_EQ(find(), (Pairs{{shade, pole}})) << "in which the wall is seen";
  paint({39, 20, 2, 2}, 0);
  EXPECT_EQ(find(), (Pairs{{shade, pole}})) << "without depth";
  paint({39, 20, 2, 2}, kThing_mm);
  EXPECT_EQ(find(), Pairs{}) << "something else is between them";
}

TEST_F(HeldObjectsTest, NotAcrossThreeCells) {
  add(kShade);
  add({39, 23, 2, 22});
  EXPECT_EQ(find(), Pairs{});
}

// A cup on a table, a cap on a bottle of the same width.
TEST_F(HeldObjectsTest, TheHolderIsNarrower) {
  add(kShade);
  const cv::Rect just_narrow{32, 20, 16, 10}, too_wide{31, 20, 17, 10};
  const int holder = add(just_narrow);
  EXPECT_EQ(find(), (Pairs{{0, holder}}));
  extend(holder, too_wide);
  EXPECT_EQ(find(), Pairs{});
}

TEST_F(HeldObjectsTest, MostOfTheHoldersUpperEdgeIsUnderIt) {
  add({30, 10, 20, 10});
  const int holder = add({44, 20, 10, 10});
  EXPECT_EQ(find(), (Pairs{{0, holder}})) << "six of ten cells";
  object_of_.assign(object_of_.size(), -1);
  extend(0, {30, 10, 20, 10});
  extend(holder, {45, 20, 10, 10});
  EXPECT_EQ(find(), Pairs{}) << "five of ten cells";
}

// A row of books before the back of its shelf.
TEST_F(HeldObjectsTest, WhatIsInFrontHoldsNothing) {
  add(kShade, 1700);
  add(kPole, 1500);
  EXPECT_EQ(find(), Pairs{});
}

// A chair that is seen under a table, at the other end of the room.
TEST_F(HeldObjectsTest, WhatIsFarBehindHoldsNothing) {
  add(kShade, 1500);
  add(kPole, 2000);
  EXPECT_EQ(find(), Pairs{});
}

// A cushion on a sofa, which goes on to its left and right.
TEST_F(HeldObjectsTest, WhatIsSurroundedHoldsNothing) {
  const int sofa = add({20, 10, 40, 10});
  add({35, 20, 10, 10});
  extend(sofa, {20, 20, 15, 10});
  extend(sofa, {45, 20, 15, 10});
  EXPECT_EQ(find(), Pairs{});
}

// A cupboard at which a narrow thing stands: the floor that it stands on is at its depth.
TEST_F(HeldObjectsTest, WhatStandsOnTheFloorIsNotHeld) {
  add(kShade);
  add(kPole);
  paint({30, 20, 9, 10}, kThing_mm);
  paint({41, 20, 9, 10}, kThing_mm);
  EXPECT_EQ(find(), Pairs{});
}

TEST_F(HeldObjectsTest, WhatLeavesTheImageBelowMayStandThere) {
  const int cupboard = add({30, 10, 20, 10});
  add({39, 20, 2, 25});
  extend(cupboard, {30, 20, 8, 40});
  extend(cupboard, {42, 20, 8, 40});
  EXPECT_EQ(find(), Pairs{});
}

TEST_F(HeldObjectsTest, NothingHoldsNothing) {
  EXPECT_EQ(find(), Pairs{});
  add(kShade);
  EXPECT_EQ(find(), Pairs{});
}

}  // namespace
}  // namespace saccade
