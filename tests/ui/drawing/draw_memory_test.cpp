#include "ui/drawing/draw_memory.hpp"

#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/ui/support/imgui_frames.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const cv::Rect kWhole(0, 0, 340, 900);

class DrawMemoryTest : public ::testing::Test {
 protected:
  std::vector<cv::Rect> changes(const std::function<void(ImDrawList&)>& draw,
                                std::span<const ImTextureID> renewed = {}) {
    frames_.frame([&] { draw(*ImGui::GetWindowDrawList()); });
    return memory_.changes(*ImGui::GetDrawData(), renewed);
  }
  static void box(ImDrawList& list, float x, float y, unsigned colour = IM_COL32_WHITE) {
    list.AddRectFilled({x, y}, {x + 10, y + 20}, colour);
  }

  test::ImGuiFrames frames_;
  DrawMemory memory_;
};

TEST_F(DrawMemoryTest, OnlyWhatDiffersIsChanged) {
  const auto three = [](float y, unsigned colour) {
    return [y, colour](ImDrawList& list) {
      box(list, 20, 30);
      box(list, 100, y, colour);
      box(list, 200, 500);
    };
  };
  EXPECT_THAT(changes(three(100, IM_COL32_WHITE)), ElementsAre(kWhole)) << "the first";
  EXPECT_THAT(changes(three(100, IM_COL32_WHITE)), IsEmpty());
  EXPECT_THAT(changes(three(100, IM_COL32_BLACK)), ElementsAre(cv::Rect(99, 99, 12, 22)));
  EXPECT_THAT(changes(three(110, IM_COL32_BLACK)), ElementsAre(cv::Rect(99, 99, 12, 32)))
      << "where it was and where it is";
  memory_.forget();
  EXPECT_THAT(changes(three(110, IM_COL32_BLACK)), ElementsAre(kWhole));
}

TEST_F(DrawMemoryTest, WhatComesAndGoesIsChanged) {
  const auto boxes = [](bool more) {
    return [more](ImDrawList& list) {
      box(list, 20, 30);
      if (more) box(list, 50, 60);
      box(list, 100, 100);
    };
  };
  changes(boxes(false));
  EXPECT_THAT(changes(boxes(true)), ElementsAre(cv::Rect(49, 59, 12, 22)));
  EXPECT_THAT(changes(boxes(false)), ElementsAre(cv::Rect(49, 59, 12, 22)));
}

TEST_F(DrawMemoryTest, NothingIsChangedOutsideOfItsClip) {
  const auto clipped = [](unsigned colour) {
    return [colour](ImDrawList& list) {
      list.PushClipRect({100, 100}, {105, 110}, true);
      box(list, 95, 95, colour);
      list.PopClipRect();
    };
  };
  changes(clipped(IM_COL32_WHITE));
  EXPECT_THAT(changes(clipped(IM_COL32_BLACK)), ElementsAre(cv::Rect(99, 99, 7, 12)));
}

TEST_F(DrawMemoryTest, ARenewedTextureIsChangedWhereItIs) {
  int x = 0;
  const ImTextureID picture = &x;
  const auto image = [&](ImDrawList& list) { list.AddImage(picture, {100, 100}, {200, 150}); };
  changes(image);
  EXPECT_THAT(changes(image), IsEmpty());
  EXPECT_THAT(changes(image, {&picture, 1}), ElementsAre(cv::Rect(99, 99, 102, 52)));
}

TEST_F(DrawMemoryTest, WindowsComeAndGo) {
  const auto with_popup = [this](bool popup) {
    frames_.frame([&] {
      box(*ImGui::GetWindowDrawList(), 20, 30);
      if (popup) box(*ImGui::GetForegroundDrawList(), 50, 60);
    });
    return memory_.changes(*ImGui::GetDrawData(), {});
  };
  with_popup(false);
  EXPECT_THAT(with_popup(true), ElementsAre(cv::Rect(49, 59, 12, 22)));
  EXPECT_THAT(with_popup(true), IsEmpty());
  EXPECT_THAT(with_popup(false), ElementsAre(cv::Rect(49, 59, 12, 22)));
}

TEST_F(DrawMemoryTest, ADrawingWithACallbackIsRefused) {
  EXPECT_THROW(changes([](ImDrawList& list) { list.AddCallback([](auto...) {}, nullptr); }),
               std::invalid_argument);
}

TEST_F(DrawMemoryTest, CutsClipsToAPart) {
  frames_.frame([&] { box(*ImGui::GetWindowDrawList(), 20, 30); });
  ImDrawData& data = *ImGui::GetDrawData();
  const std::vector<ImVec4> whole = clips_of(data);
  cut(data, whole, {10, 20, 30, 40});
  cut(data, whole, {15, 25, 30, 40});
  for (const ImVec4& clip : clips_of(data)) {
    EXPECT_GE(clip.x, 15);
    EXPECT_LE(clip.z, 45);
    EXPECT_GE(clip.y, 25);
    EXPECT_LE(clip.w, 65);
  }
}

}  // namespace
}  // namespace saccade
