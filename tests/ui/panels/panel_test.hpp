#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/ui/support/fake_graphics.hpp"
#include "tests/ui/support/imgui_frames.hpp"
#include "ui/panels/view_context.hpp"

namespace saccade {

using test::ImGuiFrames;

/// A panel without a display: what it shows and what a click in it does.
class ViewerPanelsTest : public ::testing::Test {
 protected:
  explicit ViewerPanelsTest(float width = 332, float height = 700) : frames_(width, height) {
    view_.colours = &colours_of(Theme::dark);
    view_.fonts = {ImGui::GetFont(), ImGui::GetIO().Fonts->Fonts[0]};
    view_.act = [this](Action action) { acts_.push_back(action); };
    view_.open = [this](const std::string& uri) { opened_ = uri; };
  }

  void show_result(cv::Size size = {640, 480}) {
    auto result = std::make_shared<ViewResult>();
    result->serial = 1;
    for (Computed* side : {&result->a, &result->b}) {
      side->result.frame.depth_mm = cv::Mat1f(size, 1000.0F);
      side->result.maps.master = cv::Mat1f(size, 0.25F);
      side->smooth = side->result.maps.master;
      side->result.attention.fixations = {{100, 200, 1, {10, 20, 1000}, {}}, {300, 400, 0.5F, {}, {}}};
    }
    result->compared = true;
    view_.result = result;
    view_.source.phase = SessionState::Phase::open;
    view_.source.source.size = size;
    view_.source.source.frame_count = 16;
    view_.timeline.reset(16);
  }

  using Draw = std::function<void()>;
  ImGuiFrames::Drawn settled(const Draw& draw) {
    frames_.frame(draw);
    return frames_.frame(draw);
  }

  // A click on a share of the width of a thing whose place the panel logs.
  void click(const char* place, const Draw& draw, float across = 0.5F) {
    settled(draw);
    const auto [left, top, right, bottom] = view_.places.at(place);
    frames_.click({left + across * (right - left), (top + bottom) / 2}, draw);
  }

  void expect_fits(const Draw& draw) {
    const auto drawn = settled(draw);
    // Behind a pair of drag fields ImGui puts a label, here an empty one, after a gap.
    EXPECT_LE(drawn.content_width, drawn.window_width + ImGui::GetStyle().ItemInnerSpacing.x);
  }

  ImGuiFrames frames_;
  ViewState state_;
  Session session_{[](auto&&...) -> std::unique_ptr<FrameSource> { throw failed("none", "", ""); }, [] {},
                   ComputeRequest{}};
  test::FakeGraphics graphics_;
  ViewContext view_{state_, session_, graphics_};
  std::vector<Action> acts_;
  std::string opened_;
};

}  // namespace saccade
