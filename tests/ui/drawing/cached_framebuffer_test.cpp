// Drawing the damage gives the same pixels as drawing everything.
#include "ui/drawing/cached_framebuffer.hpp"

#include <array>
#include <memory>

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include "gl_test.hpp"

namespace saccade {
namespace {

// The contents of a frame; by default those of the first one.
struct Scene {
  int kernel = 15;
  bool popup = false, wide = false;
  unsigned colour = IM_COL32(255, 120, 0, 255);
  float line_end = 90;
};

class CachedFramebufferTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplOpenGL3_Init("#version 330 core");
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    set_texture(10);
    cached_ = std::make_unique<CachedFramebuffer>();
    reference_ = std::make_unique<CachedFramebuffer>();
  }
  void TearDown() override {
    if (cached_) {
      cached_.reset();
      reference_.reset();
      glDeleteTextures(1, &texture_);
      ImGui_ImplOpenGL3_Shutdown();
      ImGui::DestroyContext();
    }
    GlTest::TearDown();
  }

  void set_texture(std::uint8_t value) {
    std::array<std::uint8_t, 16> pixels;
    pixels.fill(value);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  }
  ImTextureID texture() const { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_)); }

  void lay_out(const Scene& scene) const {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {scene.wide ? 320.0F : 300.0F, 200};
    io.DeltaTime = 1.0F / 60;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({10, 10});
    ImGui::SetNextWindowSize({120, 150});
    ImGui::Begin("left", nullptr, ImGuiWindowFlags_NoDecoration);
    ImGui::Text("k %d", scene.kernel);
    ImGui::Image(texture(), {40, 40});
    ImGui::End();
    ImGui::SetNextWindowPos({150, 20});
    ImGui::SetNextWindowSize({120, 150});
    ImGui::Begin("right", nullptr, ImGuiWindowFlags_NoDecoration);
    ImGui::GetWindowDrawList()->AddLine({160, 30}, {160 + scene.line_end, 120}, scene.colour, 3);
    ImGui::Text("unchanged");
    ImGui::End();
    if (scene.popup) {
      ImGui::SetNextWindowPos({100, 60});
      ImGui::Begin("popup", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
      ImGui::Text("over both");
      ImGui::End();
    }
    ImGui::Render();
  }

  // Draws what has changed, and beside it everything; whether anything was drawn.
  bool draw(const Scene& scene, std::span<const TextureId> renewed = {}) {
    for (int settled = 0; settled < 2; ++settled) lay_out(scene);
    const cv::Scalar background(0.1, 0.2, 0.3);
    const bool drawn = cached_->draw(*ImGui::GetDrawData(), background, renewed);
    lay_out(scene);
    reference_->reset();
    EXPECT_TRUE(reference_->draw(*ImGui::GetDrawData(), background, renewed));
    EXPECT_EQ(cv::norm(cached_->read_pixels(), reference_->read_pixels(), cv::NORM_INF), 0);
    EXPECT_EQ(glGetError(), static_cast<unsigned>(GL_NO_ERROR));
    return drawn;
  }

  unsigned texture_ = 0;
  std::unique_ptr<CachedFramebuffer> cached_, reference_;
};

TEST_F(CachedFramebufferTest, PartsLookLikeTheWhole) {
  Scene scene;
  EXPECT_TRUE(draw(scene));
  EXPECT_GT(cv::norm(cached_->read_pixels().row(40)), 0);
  EXPECT_FALSE(draw(scene)) << "nothing has changed";
  scene.kernel = 17;
  EXPECT_TRUE(draw(scene));
  scene.colour = IM_COL32(0, 200, 255, 128);
  scene.line_end = 60;
  EXPECT_TRUE(draw(scene));
  scene.popup = true;
  EXPECT_TRUE(draw(scene));
  scene.kernel = 127;
  scene.line_end = 80;
  EXPECT_TRUE(draw(scene)) << "under the popup";
  scene.popup = false;
  EXPECT_TRUE(draw(scene));
  scene.wide = true;
  EXPECT_TRUE(draw(scene)) << "another size";
  EXPECT_EQ(cached_->read_pixels().size(), cv::Size(320, 200));
}

TEST_F(CachedFramebufferTest, ATextureWithOtherPixelsIsDrawnAgain) {
  EXPECT_TRUE(draw({}));
  set_texture(200);
  const TextureId renewed = texture_;
  EXPECT_TRUE(draw({}, {&renewed, 1}));
}

}  // namespace
}  // namespace saccade
