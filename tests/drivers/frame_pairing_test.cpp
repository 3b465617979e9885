#include "drivers/openni2/frame_pairing.hpp"

#include <optional>
#include <set>

#include <gtest/gtest.h>

namespace saccade {
namespace {

constexpr std::int64_t kPeriod_us = 33'333;

// Images that show when they were taken.
class FramePairingTest : public ::testing::Test {
 protected:
  FramePairingTest() { pairing_.restart(kPeriod_us, true); }

  void depth(std::int64_t time_us) {
    cv::Mat1f image(2, 3, static_cast<float>(time_us));
    pairing_.put_depth(image, time_us);
  }

  void colour(std::int64_t time_us) {
    cv::Mat3b image(2, 3, of(time_us));
    pairing_.put_colour(image, time_us);
  }

  static cv::Vec3b of(std::int64_t time_us) {
    return {static_cast<std::uint8_t>(time_us), static_cast<std::uint8_t>(time_us >> 8), 0};
  }

  // Takes the depth frame that waits; true if its colour is that of `colour_us`, or none if that is empty.
  ::testing::AssertionResult gives(std::int64_t depth_us, std::optional<std::int64_t> colour_us) {
    cv::Mat1f depth_mm;
    cv::Mat3b image(1, 1);
    const auto taken = pairing_.take(depth_mm, image);
    if (taken.time_us != depth_us || depth_mm(1, 2) != static_cast<float>(depth_us))
      return ::testing::AssertionFailure() << "depth of " << taken.time_us;
    if (taken.colour_missed != !colour_us) return ::testing::AssertionFailure() << "colour_missed is wrong";
    if (image.empty() != !colour_us) return ::testing::AssertionFailure() << "colour where none is meant";
    if (colour_us && image(1, 2) != of(*colour_us)) return ::testing::AssertionFailure() << "another colour";
    return ::testing::AssertionSuccess();
  }

  FramePairing pairing_;
};

TEST_F(FramePairingTest, ColourMayComeFirstOrLast) {
  EXPECT_FALSE(pairing_.is_ripe());
  colour(1000);
  EXPECT_FALSE(pairing_.is_ripe()) << "colour alone is no frame";
  depth(1200);
  EXPECT_TRUE(pairing_.is_ripe());
  EXPECT_TRUE(gives(1200, 1000));
  depth(34'500);
  EXPECT_FALSE(pairing_.is_ripe()) << "the colour that is there was used";
  colour(34'300);
  EXPECT_TRUE(pairing_.is_ripe());
  EXPECT_TRUE(gives(34'500, 34'300));
}

TEST_F(FramePairingTest, TheToleranceIsHalfAPeriod) {
  for (const std::int64_t apart_us : {-16'667, -16'666, 16'666, 16'667}) {
    pairing_.restart(kPeriod_us, true);
    depth(100'000);
    colour(100'000 + apart_us);
    const bool fits = std::abs(apart_us) <= kPeriod_us / 2;
    EXPECT_TRUE(gives(100'000, fits ? std::optional(100'000 + apart_us) : std::nullopt)) << apart_us;
  }
}

TEST_F(FramePairingTest, TheNearerOfTwoIsTaken) {
  colour(95'000);
  colour(110'000);
  depth(100'000);
  EXPECT_TRUE(gives(100'000, 95'000));
  colour(195'000);
  colour(203'000);
  depth(200'000);
  EXPECT_TRUE(gives(200'000, 203'000));
}

TEST_F(FramePairingTest, AColourThatIsTooLateEndsTheWaiting) {
  depth(100'000);
  colour(60'000);
  EXPECT_FALSE(pairing_.is_ripe()) << "its own may still come";
  colour(130'000);
  EXPECT_TRUE(pairing_.is_ripe()) << "none that is earlier comes after this one";
  EXPECT_TRUE(gives(100'000, std::nullopt));
  depth(133'333);
  EXPECT_TRUE(gives(133'333, 130'000)) << "it was the next one's";
}

TEST_F(FramePairingTest, WithoutAColourStreamNothingWaits) {
  pairing_.restart(kPeriod_us, false);
  depth(5);
  EXPECT_TRUE(pairing_.is_ripe());
  cv::Mat1f depth_mm;
  cv::Mat3b image;
  EXPECT_FALSE(pairing_.take(depth_mm, image).colour_missed) << "there is none to miss";
  EXPECT_TRUE(image.empty());
}

TEST_F(FramePairingTest, ADeviceThatIsFasterThanItsModeIsNoticed) {
  for (std::int64_t t : {0, 8'333, 16'666}) {
    depth(t);
    colour(t);
    EXPECT_TRUE(gives(t, t));
  }
  colour(16'667);
  depth(25'000);
  EXPECT_FALSE(pairing_.is_ripe()) << "that colour is of the frame before";
  colour(25'000);
  EXPECT_TRUE(gives(25'000, 25'000));
}

TEST_F(FramePairingTest, OneOddTimeDoesNotSpoilTheRest) {
  depth(100'000);
  EXPECT_TRUE(gives(100'000, std::nullopt));
  depth(100'001);
  EXPECT_TRUE(gives(100'001, std::nullopt));
  std::int64_t t = 100'001;
  for (int k = 0; k < 32; ++k) {
    depth(t += kPeriod_us);
    pairing_.is_ripe();
    colour(t + 900);
    EXPECT_TRUE(gives(t, k < 31 ? std::nullopt : std::optional(t + 900))) << k;
  }
}

TEST_F(FramePairingTest, AClockThatGoesBackIsNoPeriod) {
  depth(100'000);
  EXPECT_TRUE(gives(100'000, std::nullopt));
  depth(40'000);
  colour(55'000);
  EXPECT_TRUE(gives(40'000, 55'000));
}

TEST_F(FramePairingTest, AfterOpeningAgainNothingOfBeforeIsLeft) {
  depth(100'000);
  colour(100'000);
  pairing_.restart(kPeriod_us, true);
  EXPECT_FALSE(pairing_.has_depth());
  depth(100'000);
  EXPECT_TRUE(gives(100'000, std::nullopt));
  cv::Mat1f depth_mm;
  cv::Mat3b image;
  EXPECT_THROW(pairing_.take(depth_mm, image), std::bad_optional_access);
}

TEST_F(FramePairingTest, MemoryIsExchangedNotMade) {
  cv::Mat1f in(4, 4), out(4, 4);
  cv::Mat3b colour_in(4, 4), colour_out(4, 4);
  std::set<const void*> memory = {in.data, out.data, colour_in.data, colour_out.data};
  for (int k = 0; k < 10; ++k) {
    pairing_.put_colour(colour_in, k * kPeriod_us);
    pairing_.put_depth(in, k * kPeriod_us);
    pairing_.take(out, colour_out);
    in.create(4, 4);
    colour_in.create(4, 4);
    if (k < 3) memory.insert({in.data, colour_in.data});
    EXPECT_TRUE(memory.contains(out.data) && memory.contains(colour_out.data)) << k;
    EXPECT_TRUE(memory.contains(in.data) && memory.contains(colour_in.data)) << k;
  }
}

}  // namespace
}  // namespace saccade
