// What stands out of a large segment by its colour is a segment of its own.
#include "tracking/colour_patches.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

const cv::Vec3b kBlue(150, 70, 60), kRed(40, 40, 160);

// 320 x 240 pixels, 80 x 60 cells: a wall and before it a board of 120 x 72 pixels, at 2 m half a square
// metre, smaller than a supporting plane.
class ColourPatchesTest : public ::testing::Test {
 protected:
  const cv::Rect kBoard{100, 80, 120, 72};

  ColourPatchesTest() {
    colour_(kBoard) = kWood;
    build(2000);
  }

  void build(float board_mm) {
    cv::Mat1f depth(240, 320, board_mm + 1000);
    depth(kBoard) = board_mm;
    grid_.build(depth, Intrinsics::guess_for(depth.size()));
    segments_.grow(grid_);
    before_ = segments_.count();
  }

  // A place on the board, pixels of the image; multiples of 4.
  void paint(const cv::Rect& place, const cv::Vec3b& colour) { colour_(place) = colour; }

  int cut() {
    patches_.cut(grid_, colour_, segments_);
    return segments_.count() - before_;
  }

  int segment_at(int col, int row) const {
    return segments_.of_cell()[static_cast<std::size_t>(row / 4 * 80 + col / 4)];
  }

  int cells_of(int segment) const {
    return static_cast<int>(std::count(segments_.of_cell().begin(), segments_.of_cell().end(), segment));
  }

  SurfaceGrid grid_;
  SurfaceSegments segments_;
  ColourPatches patches_;
  cv::Mat3b colour_ = cv::Mat3b(240, 320, cv::Vec3b(200, 200, 200));
  int before_ = 0;
};

TEST_F(ColourPatchesTest, WhatStandsOutIsASegment) {
  const cv::Rect one(112, 92, 32, 24), other(160, 100, 24, 40);
  paint(one, kGreen);
  paint(other, kBlue);
  const int board = segment_at(104, 84), all = cells_of(board);
  EXPECT_EQ(cut(), 2);
  const int a = segment_at(120, 100), b = segment_at(170, 120);
  EXPECT_NE(a, b);
  EXPECT_TRUE(segments_.is_cut(a) && segments_.is_cut(b));
  EXPECT_FALSE(segments_.is_supporting_plane(a));
  EXPECT_EQ(cells_of(a), 8 * 6);
  EXPECT_EQ(cells_of(b), 6 * 10);
  EXPECT_EQ(segment_at(104, 84), board);
  EXPECT_FALSE(segments_.is_cut(board));
  EXPECT_EQ(cells_of(board), all - 8 * 6 - 6 * 10);
}

TEST_F(ColourPatchesTest, PatchesOfSeveralColoursThatTouchAreOne) {
  paint({120, 92, 32, 40}, kGreen);
  paint({152, 92, 32, 40}, kRed);
  EXPECT_EQ(cut(), 1);
}

TEST_F(ColourPatchesTest, StripsAreNot) {
  paint({100, 80, 120, 16}, kGreen);
  paint({100, 96, 16, 56}, kGreen);
  EXPECT_EQ(cut(), 0) << "four cells wide";
  paint({100, 80, 120, 20}, kGreen);
  EXPECT_EQ(cut(), 1) << "five cells wide";
}

TEST_F(ColourPatchesTest, ShadowsAndDarkPlacesAreNot) {
  paint({112, 92, 32, 24}, kDarkWood);
  paint({160, 100, 24, 40}, kBlack);
  EXPECT_EQ(cut(), 0);
}

TEST_F(ColourPatchesTest, AThingOfManyColoursIsOne) {
  for (int k = 0; k < 5; ++k)
    paint({100 + 24 * k, 80, 24, 72},
          cv::Vec3b(k % 2 == 0 ? 150 : 20, static_cast<uchar>(35 * k), k < 2 ? 200 : 40));
  EXPECT_EQ(cut(), 0);
}

TEST_F(ColourPatchesTest, ASmallThingIsOne) {
  build(1000);
  paint({112, 92, 32, 24}, kGreen);
  EXPECT_EQ(cut(), 0);
}

TEST_F(ColourPatchesTest, WithoutColourNothingIsCut) {
  paint({112, 92, 32, 24}, kGreen);
  colour_.release();
  EXPECT_EQ(cut(), 0);
}

// The wall takes most of the view.
TEST_F(ColourPatchesTest, ASupportingPlaneIsNotSearched) {
  colour_(cv::Rect(20, 20, 40, 40)) = kGreen;
  ASSERT_TRUE(segments_.is_supporting_plane(segment_at(40, 40)));
  EXPECT_EQ(cut(), 0);
}

}  // namespace
}  // namespace saccade
