#include "scene/event.hpp"

#include <set>

#include <gtest/gtest.h>

#include "camera.hpp"
#include "scene/camera_path.hpp"
#include "scene/render.hpp"

namespace saccade::scene {
namespace {

std::set<int> labels_at(const Scene& scene, const Event& event, double time_s) {
  SceneRender view;
  const Scene now = scene_at(scene, event, time_s);
  render(now, kCamera, kSize, camera_on(scene, CameraPath::still, time_s), view);
  return {view.labels.begin(), view.labels.end()};
}

TEST(Event, WhatIsTakenIsGoneAndWhatIsAddedHasCome) {
  for (const char* name : {"table", "room"})
    for (const std::uint64_t seed : {1u, 2u}) {
      const Scene scene = make_scene(name, {seed, {}, {}});
      const Event take = plan_event(scene, EventKind::take, 1, seed);
      EXPECT_TRUE(labels_at(scene, take, 0.99).contains(take.label));
      EXPECT_FALSE(labels_at(scene, take, 1).contains(take.label));
      const Event add = plan_event(scene, EventKind::add, 1, seed);
      EXPECT_FALSE(labels_at(scene, add, 0.99).contains(add.label));
      EXPECT_TRUE(labels_at(scene, add, 1).contains(add.label));
      auto others = labels_at(scene, take, 1);
      others.insert(take.label);
      EXPECT_EQ(others, labels_at(scene, take, 0)) << "the others keep their labels";
    }
}

TEST(Event, TheBoardHidesTheObjectAndGoes) {
  const Scene scene = make_scene("table", {3, {}, {}});
  const Event hide = plan_event(scene, EventKind::hide, 1, 3);
  const int board = scene.objects + 1;
  EXPECT_FALSE(labels_at(scene, hide, 0.9).contains(board));
  const auto during = labels_at(scene, hide, 1 + kHide_s / 2);
  EXPECT_TRUE(during.contains(board));
  EXPECT_FALSE(during.contains(hide.label));
  const auto after = labels_at(scene, hide, 1 + 2 * kHide_s);
  EXPECT_FALSE(after.contains(board));
  EXPECT_TRUE(after.contains(hide.label));
}

TEST(CameraPath, BeginsAtTheStillCameraAndReturns) {
  const Scene scene = make_scene("room", {1, {}, {}});
  const Pose still = camera_on(scene, CameraPath::still, 5);
  for (const auto& [path, period_s] :
       {std::pair{CameraPath::pan, kPanPeriod_s}, std::pair{CameraPath::walk, kWalkPeriod_s}}) {
    const Pose begin = camera_on(scene, path, 0), middle = camera_on(scene, path, period_s / 2);
    EXPECT_LT((begin.position_mm - still.position_mm).norm(), 1e-6);
    EXPECT_LT((begin.rotation - still.rotation).norm(), 1e-9);
    EXPECT_GT((middle.rotation - still.rotation).norm() + (middle.position_mm - still.position_mm).norm(),
              0.5);
  }
}

}  // namespace
}  // namespace saccade::scene
