// Objects that cling to each other and have the same colour are parts of one thing, and what is held of its
// holder.
#include "tracking/object_parts.hpp"

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

// 320 x 240 pixels, 80 x 60 cells: a wall at 3 m and before it, at 1 m, three things side by side, each of 40
// x 80 pixels, with a step of `step_mm` in depth from one to the next.
class ObjectPartsTest : public ::testing::Test {
 protected:
  ObjectPartsTest() { build(0); }

  void build(float step_mm) {
    cv::Mat1f depth(240, 320, 3000.0F);
    for (int k = 0; k < 3; ++k) depth(place(k)) = 1000.0F + step_mm * static_cast<float>(k);
    grid_.build(depth, Intrinsics::guess_for(depth.size()));
    segments_.grow(grid_);
  }

  static cv::Rect place(int k) { return {100 + 40 * k, 80, 40, 80}; }

  // The object on the k-th thing.
  int add(int k, const cv::Vec3b& colour) { return add(place(k), colour); }

  int add(const cv::Rect& place, const cv::Vec3b& colour) {
    TrackedObject& object = objects_.add();
    objects_.give_id(object);
    object.sight = Sight::visible;
    for (int row = place.y; row < place.br().y; row += 4)
      for (int col = place.x; col < place.br().x; col += 4) object.cells.push_back(row / 4 * 80 + col / 4);
    colour_(place) = colour;
    return object.id;
  }

  // Frames of 0.1 s.
  void watch(int frames) {
    for (int k = 0; k < frames; ++k) {
      for (TrackedObject& object : objects_.slots()) ++object.frames_seen;
      parts_.find(grid_, segments_, colour_, 0.1, objects_);
    }
  }

  int thing_of(int id) { return objects_.find(id)->thing; }

  SurfaceGrid grid_;
  SurfaceSegments segments_;
  cv::Mat3b colour_ = cv::Mat3b(240, 320, cv::Vec3b(200, 200, 200));
  ObjectMemory objects_{30};
  ObjectParts parts_;
};

TEST_F(ObjectPartsTest, WhatClingsAndHasOneColourIsOneThing) {
  const int a = add(0, kWood), c = add(2, kWood), b = add(1, kDarkWood);
  watch(1);
  EXPECT_EQ(thing_of(a), a) << "the oldest";
  EXPECT_EQ(thing_of(b), a);
  EXPECT_EQ(thing_of(c), a) << "by the one between them";
  EXPECT_FALSE(objects_.find(a)->is_part());
  EXPECT_TRUE(objects_.find(c)->is_part());
}

TEST_F(ObjectPartsTest, AnotherColourIsAnotherThing) {
  const int a = add(0, kWood), b = add(1, kGreen), c = add(2, kBlack);
  watch(3);
  for (const int id : {a, b, c}) EXPECT_EQ(thing_of(id), id);
}

// Stripes have the mean of their colours, but not their spread.
TEST_F(ObjectPartsTest, ColoursThatAreTheSameOnAverageAreNot) {
  const int a = add(0, {93, 93, 93}), b = add(1, {93, 93, 93});
  cv::Mat3b striped = colour_(place(1));
  for (int row = 0; row < striped.rows; ++row)
    striped.row(row) = row / 4 % 2 == 0 ? cv::Vec3b(40, 100, 140) : cv::Vec3b(146, 86, 46);
  watch(3);
  EXPECT_EQ(thing_of(a), a);
  EXPECT_EQ(thing_of(b), b);
}

// The boards of a shelf, of which one has a book before it.
TEST_F(ObjectPartsTest, WhatMostOfBothHaveIsTheirColour) {
  const int a = add(0, kWood), b = add(1, kWood);
  colour_(cv::Rect(144, 80, 32, 28)) = kGreen;  // 28 of 80 rows, 8 of 10 columns
  watch(1);
  EXPECT_EQ(thing_of(b), a);
}

TEST_F(ObjectPartsTest, WhatTheyHaveHereAndThereIsNot) {
  const int a = add(0, kWood), b = add(1, kWood);
  colour_(cv::Rect(140, 80, 40, 32)) = kGreen;
  watch(3);
  EXPECT_EQ(thing_of(a), a);
  EXPECT_EQ(thing_of(b), b);
}

// A pole under a shade, of other colours.
TEST_F(ObjectPartsTest, WhatIsHeldIsAPartOfItsHolder) {
  cv::Mat1f depth(240, 320, 3000.0F);
  const cv::Rect shade(120, 40, 80, 40), pole(156, 80, 8, 80);
  depth(shade) = 1000;
  depth(pole) = 1000;
  grid_.build(depth, Intrinsics::guess_for(depth.size()));
  segments_.grow(grid_);
  const int held = add(shade, kGreen), holder = add(pole, kBlack);
  watch(1);
  EXPECT_EQ(thing_of(holder), held);
  colour_.release();
  parts_.clear();
  watch(1);
  EXPECT_EQ(thing_of(holder), held) << "without colour too";
}

TEST_F(ObjectPartsTest, AStepInDepthParts) {
  build(60);
  const int a = add(0, kWood), b = add(1, kWood);
  watch(3);
  EXPECT_EQ(thing_of(a), a);
  EXPECT_EQ(thing_of(b), b);
}

TEST_F(ObjectPartsTest, WithoutColourNothingIsKnown) {
  add(0, kWood);
  const int b = add(1, kWood);
  colour_.release();
  watch(3);
  EXPECT_EQ(thing_of(b), b);
}

TEST_F(ObjectPartsTest, WhatWasReportedForAWhileStaysItself) {
  const int a = add(0, kWood), b = add(1, kGreen);
  watch(ObjectParts::kNewFrames);
  colour_(place(1)) = kWood;
  watch(20);
  EXPECT_EQ(thing_of(b), b);
  const int c = add(2, kWood);
  watch(1);
  EXPECT_EQ(thing_of(c), b) << "but what comes to it is its part";
  EXPECT_EQ(thing_of(a), a);
}

// From kWood, kOak is .033 away in chromaticity and kPine .017; kSameColour is .045.
TEST_F(ObjectPartsTest, WhatIsNewJoinsTwoOldThingsOnlyIfTheColoursAreSurelyTheSame) {
  const cv::Vec3b kOak(68, 90, 126), kPine(64, 90, 128);
  for (const bool surely : {false, true}) {
    for (const bool old : {false, true}) {
      objects_.clear();
      parts_.clear();
      const int a = add(0, kWood), c = add(2, surely ? kPine : kOak);
      if (old) watch(ObjectParts::kNewFrames);
      const int b = add(1, kWood);
      watch(3);
      EXPECT_EQ(thing_of(b), a);
      EXPECT_EQ(thing_of(c), surely || !old ? a : c) << surely << old;
    }
  }
}

TEST_F(ObjectPartsTest, PartsThatComeApartAreThingsAfterAWhile) {
  const int a = add(0, kWood), b = add(1, kWood);
  watch(1);
  build(60);
  watch(29);
  EXPECT_EQ(thing_of(b), a);
  watch(2);
  EXPECT_EQ(thing_of(b), b);
}

TEST_F(ObjectPartsTest, AnotherPartIsReportedWhileTheFirstIsHidden) {
  const int a = add(0, kWood), b = add(1, kWood), c = add(2, kWood);
  watch(1);
  objects_.find(a)->sight = Sight::hidden;
  watch(50);
  EXPECT_EQ(thing_of(b), b);
  EXPECT_EQ(thing_of(c), b);
  objects_.find(a)->sight = Sight::visible;
  watch(1);
  EXPECT_EQ(thing_of(c), a) << "what is out of sight is not forgotten";
}

TEST_F(ObjectPartsTest, WhatWasChosenMostOftenIsReported) {
  const int a = add(0, kWood), b = add(1, kWood), c = add(2, kWood);
  objects_.find(a)->times_chosen = 3;
  objects_.find(b)->times_chosen = 40;
  watch(1);
  for (const int id : {a, b, c}) EXPECT_EQ(thing_of(id), b);
}

TEST_F(ObjectPartsTest, ClearBeginsAgain) {
  add(0, kWood);
  const int b = add(1, kWood);
  watch(ObjectParts::kNewFrames);
  parts_.clear();
  watch(2);
  EXPECT_EQ(thing_of(b), b);
}

}  // namespace
}  // namespace saccade
