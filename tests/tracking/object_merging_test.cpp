// Parts of one convex thing become one object; things with a gap or a concave edge between them do not.
#include "tracking/object_merging.hpp"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace saccade {
namespace {

// 320 x 240 pixels, 80 x 60 cells: a wall at 3 m and before it a thing of 80 x 80 pixels, whose depth
// changes by `slope` mm per pixel from its middle column on both sides.
class ObjectMergingTest : public ::testing::Test {
 protected:
  void build(double slope) {
    cv::Mat1f depth(240, 320, 3000.0F);
    for (int r = 80; r < 160; ++r)
      for (int c = 120; c < 200; ++c) depth(r, c) = static_cast<float>(1000 + slope * std::abs(c - 160));
    grid_.build(depth, Intrinsics::guess_for(depth.size()));
    segments_.grow(grid_);
    surfaces_.clear();
    surfaces_.carry(grid_, {});
  }

  static int cell(int row, int col) { return row / 4 * 80 + col / 4; }

  // An object with its anchor at a pixel, whose cells are those of the thing from column `from` to `to`.
  int add(int row, int col, int from, int to) {
    TrackedObject& object = objects_.add();
    objects_.give_id(object);
    object.rank = object.id;
    object.sight = Sight::visible;
    object.anchor_cell = cell(row, col);
    for (int r = 80; r < 160; r += 4)
      for (int c = from; c < to; c += 4) {
        object.cells.push_back(cell(r, c));
        surfaces_.owner()[static_cast<std::size_t>(cell(r, c))] = objects_.owner_of(object);
      }
    return object.id;
  }

  // Frames of 0.1 s.
  void watch(int frames) {
    for (int k = 0; k < frames; ++k) merging_.merge(grid_, segments_, 0.1, objects_, surfaces_);
  }

  int alive() const {
    int count = 0;
    for (const TrackedObject& object : objects_.slots()) count += object.alive;
    return count;
  }

  SurfaceGrid grid_;
  SurfaceSegments segments_;
  SurfaceMemory surfaces_;
  ObjectMemory objects_{30};
  ObjectMerging merging_;
};

TEST_F(ObjectMergingTest, FlatAndConvexAreOneConcaveIsNot) {
  build(0);
  EXPECT_TRUE(convex_between(grid_, cell(90, 130), cell(150, 190)));
  build(1);  // its middle is nearest
  EXPECT_TRUE(convex_between(grid_, cell(90, 130), cell(150, 190)));
  build(-1);
  EXPECT_FALSE(convex_between(grid_, cell(90, 130), cell(150, 190)));
  EXPECT_TRUE(convex_between(grid_, cell(90, 130), cell(150, 130))) << "along one of its sides";
}

TEST_F(ObjectMergingTest, AGapOrNoReadingBetweenIsNotConvex) {
  build(0);
  EXPECT_FALSE(convex_between(grid_, cell(120, 130), cell(120, 250))) << "from the thing to the wall";
  cv::Mat1f hole(240, 320, 1000.0F);
  hole(cv::Rect(150, 0, 20, 240)).setTo(0);
  grid_.build(hole, Intrinsics::guess_for(hole.size()));
  EXPECT_FALSE(convex_between(grid_, cell(120, 100), cell(120, 220)));
}

TEST_F(ObjectMergingTest, PartsAreJoinedAfterASecond) {
  build(1);
  const int first = add(120, 130, 120, 160);
  add(120, 190, 160, 200);
  watch(9);
  EXPECT_EQ(alive(), 2);
  watch(3);
  ASSERT_EQ(alive(), 1);
  const TrackedObject& object = objects_.slots().front();
  EXPECT_EQ(object.id, first) << "the one that is first in order";
  EXPECT_EQ(object.cells.size(), 400U);
  EXPECT_EQ(surfaces_.owner()[static_cast<std::size_t>(cell(120, 190))], objects_.owner_of(object));
}

TEST_F(ObjectMergingTest, SidesOfAValleyStayTwo) {
  build(-1);
  add(120, 130, 120, 160);
  add(120, 190, 160, 200);
  watch(40);
  EXPECT_EQ(alive(), 2);
}

TEST_F(ObjectMergingTest, ClearBeginsAgain) {
  build(1);
  add(120, 130, 120, 160);
  add(120, 190, 160, 200);
  watch(9);
  merging_.clear();
  watch(9);
  EXPECT_EQ(alive(), 2);
}

}  // namespace
}  // namespace saccade
