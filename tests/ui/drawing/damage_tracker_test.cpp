#include "ui/drawing/damage_tracker.hpp"

#include <gmock/gmock.h>

#include "tests/ui/support/imgui_frames.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const cv::Rect kWhole(0, 0, 340, 900);

class DamageTrackerTest : public ::testing::Test {
 protected:
  std::vector<cv::Rect> damage(const std::function<void(ImDrawList&)>& draw,
                               std::span<const TextureId> renewed = {}) {
    frames_.frame([&] { draw(*ImGui::GetWindowDrawList()); });
    return tracker_.damage(*ImGui::GetDrawData(), renewed);
  }
  static void box(ImDrawList& list, float x, float y, unsigned colour = IM_COL32_WHITE) {
    list.AddRectFilled({x, y}, {x + 10, y + 20}, colour);
  }

  test::ImGuiFrames frames_;
  DamageTracker tracker_;
};

TEST_F(DamageTrackerTest, OnlyWhatDiffersIsDamaged) {
  const auto three = [](float y, unsigned colour) {
    return [y, colour](ImDrawList& list) {
      box(list, 20, 30);
      box(list, 100, y, colour);
      box(list, 200, 500);
    };
  };
  EXPECT_THAT(damage(three(100, IM_COL32_WHITE)), ElementsAre(kWhole)) << "the first";
  EXPECT_THAT(damage(three(100, IM_COL32_WHITE)), IsEmpty());
  EXPECT_THAT(damage(three(100, IM_COL32_BLACK)), ElementsAre(cv::Rect(99, 99, 12, 22)));
  EXPECT_THAT(damage(three(110, IM_COL32_BLACK)), ElementsAre(cv::Rect(99, 99, 12, 32)))
      << "where it was and where it is";
  tracker_.reset();
  EXPECT_THAT(damage(three(110, IM_COL32_BLACK)), ElementsAre(kWhole));
}

TEST_F(DamageTrackerTest, WhatComesAndGoesIsDamaged) {
  const auto boxes = [](bool more) {
    return [more](ImDrawList& list) {
      box(list, 20, 30);
      if (more) box(list, 50, 60);
      box(list, 100, 100);
    };
  };
  damage(boxes(false));
  EXPECT_THAT(damage(boxes(true)), ElementsAre(cv::Rect(49, 59, 12, 22)));
  EXPECT_THAT(damage(boxes(false)), ElementsAre(cv::Rect(49, 59, 12, 22)));
}

TEST_F(DamageTrackerTest, NothingIsDamagedOutsideOfItsClip) {
  const auto clipped = [](unsigned colour) {
    return [colour](ImDrawList& list) {
      list.PushClipRect({100, 100}, {105, 110}, true);
      box(list, 95, 95, colour);
      list.PopClipRect();
    };
  };
  damage(clipped(IM_COL32_WHITE));
  EXPECT_THAT(damage(clipped(IM_COL32_BLACK)), ElementsAre(cv::Rect(99, 99, 7, 12)));
}

TEST_F(DamageTrackerTest, ARenewedTextureIsDamagedWhereItIs) {
  constexpr TextureId kPicture = 7;
  const auto image = [&](ImDrawList& list) {
    list.AddImage(reinterpret_cast<ImTextureID>(kPicture), {100, 100}, {200, 150});
  };
  damage(image);
  EXPECT_THAT(damage(image), IsEmpty());
  EXPECT_THAT(damage(image, {&kPicture, 1}), ElementsAre(cv::Rect(99, 99, 102, 52)));
}

TEST_F(DamageTrackerTest, EverythingIsDamagedWhenAWindowComesOrGoes) {
  const auto with_popup = [this](bool popup) {
    frames_.frame([&] {
      box(*ImGui::GetWindowDrawList(), 20, 30);
      if (popup) box(*ImGui::GetForegroundDrawList(), 50, 60);
    });
    return tracker_.damage(*ImGui::GetDrawData(), {});
  };
  with_popup(false);
  EXPECT_THAT(with_popup(true), ElementsAre(kWhole));
  EXPECT_THAT(with_popup(true), IsEmpty());
  EXPECT_THAT(with_popup(false), ElementsAre(kWhole));
}

TEST_F(DamageTrackerTest, ACallbackDamagesWhatItCanReach) {
  const auto callback = [](ImDrawList& list) {
    list.PushClipRect({100, 100}, {150, 120}, true);
    list.AddCallback([](auto...) {}, nullptr);
    list.PopClipRect();
  };
  damage(callback);
  EXPECT_THAT(damage(callback), ElementsAre(cv::Rect(99, 99, 52, 22)));
  EXPECT_THAT(damage([](ImDrawList&) {}), ElementsAre(cv::Rect(99, 99, 52, 22))) << "it may have drawn there";
  EXPECT_THAT(damage([](ImDrawList&) {}), IsEmpty());
}

}  // namespace
}  // namespace saccade
