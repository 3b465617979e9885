#include "ui/drawing/cloud_renderer.hpp"

#include <array>
#include <memory>

#include <epoxy/gl.h>

#include "gl_test.hpp"

namespace saccade {
namespace {

class CloudRendererTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (!IsSkipped() && !HasFatalFailure()) renderer_ = std::make_unique<CloudRenderer>();
  }
  void TearDown() override {
    renderer_.reset();
    GlTest::TearDown();
  }

  // As an image: top row first.
  cv::Mat4b drawn(const OrbitCamera& camera, cv::Size size, const CloudShading& look) {
    const unsigned texture = renderer_->draw(camera, size, look);
    cv::Mat4b pixels(size);
    glBindTexture(GL_TEXTURE_2D, texture);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data);
    EXPECT_EQ(glGetError(), static_cast<unsigned>(GL_NO_ERROR));
    cv::Mat4b upright(size);
    for (int r = 0; r < size.height; ++r) pixels.row(size.height - 1 - r).copyTo(upright.row(r));
    return upright;
  }

  std::unique_ptr<CloudRenderer> renderer_;
};

const Intrinsics kCamera = {100, 100, 31.5, 23.5};
const cv::Size kSize(64, 48);

TEST_F(CloudRendererTest, APointIsWhereTheCameraSaysAndHidesWhatIsBehind) {
  const OrbitCamera camera = OrbitCamera::at_sensor(kCamera, kSize, 1000);
  const CloudVertex near{{-100, -50, 1000}, {255, 0, 0, 255}, {}};
  const CloudVertex far{{-150, -75, 1500}, {0, 255, 0, 255}, {}};  // on the same ray
  const std::vector<CloudVertex> points = {near, far};
  renderer_->set_points(points);
  const CloudShading look{.lit = false, .point_mm_per_m = 30};
  const cv::Mat4b picture = drawn(camera, kSize, look);
  const cv::Point2d at = camera.project({-100, -50, 1000}, kSize).value();
  EXPECT_EQ(picture(static_cast<int>(at.y), static_cast<int>(at.x)), cv::Vec4b(255, 0, 0, 255));
  EXPECT_EQ(picture(40, 60), cv::Vec4b(20, 23, 28, 255)) << "the background";
}

TEST_F(CloudRendererTest, LightFallsFromTheEye) {
  const OrbitCamera camera = OrbitCamera::at_sensor(kCamera, kSize, 1000);
  const auto brightness = [&](std::array<std::int8_t, 4> normal, bool lit) {
    const std::vector<CloudVertex> points = {{{0, 0, 1000}, {200, 200, 200, 255}, normal}};
    renderer_->set_points(points);
    return drawn(camera, kSize, {.lit = lit, .point_mm_per_m = 60})(24, 32)[0];
  };
  EXPECT_EQ(brightness({0, 0, -127, 0}, true), 200) << "towards the eye";
  EXPECT_NEAR(brightness({-90, 0, -90, 0}, true), 200 * (0.4 + 0.6 * 0.7071), 2) << "at 45 degrees";
  EXPECT_EQ(brightness({-90, 0, -90, 0}, false), 200);
  EXPECT_EQ(brightness({}, true), 200) << "no normal";
}

TEST_F(CloudRendererTest, LinesAreDrawnAndTheViewportIsLeftAlone) {
  const OrbitCamera camera = OrbitCamera::at_sensor(kCamera, kSize, 1000);
  const std::vector<CloudVertex> lines = {{{-200, 1, 1000}, {255, 255, 255, 255}, {}},
                                          {{200, 1, 1000}, {255, 255, 255, 255}, {}}};
  renderer_->set_lines(lines);
  glViewport(1, 2, 3, 4);
  EXPECT_EQ(drawn(camera, kSize, {})(24, 32)[0], 255);
  EXPECT_EQ(drawn(camera, {128, 96}, {})(48, 64)[0], 255) << "another size";
  std::array<int, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  EXPECT_EQ(viewport, (std::array<int, 4>{1, 2, 3, 4}));
}

}  // namespace
}  // namespace saccade
