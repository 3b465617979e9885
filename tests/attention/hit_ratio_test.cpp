#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "attention/attention.hpp"
#include "saliency/symmetry3d.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

constexpr int kMost = 10;
const std::filesystem::path kScenes = in_shared("data/osd_learn");

struct HitRatio {
  std::array<double, kMost> hit{}, bound{};  ///< sums over the images, of n = 1..10
};

struct Found {
  std::vector<int> labels;     ///< at the points
  std::set<int> objects, hit;  ///< labels of all objects; those at the points
};

struct LabelledScene {
  cv::Mat1f depth_mm;
  cv::Mat1b labels;
};

// Every third of the real table scenes.
std::vector<LabelledScene> read_scenes() {
  std::vector<LabelledScene> scenes;
  for (int frame = 0; frame < 45; frame += 3) {
    const std::string base = kScenes / std::to_string(10000 + frame).substr(1);
    const cv::Mat depth = cv::imread(base + "_depth.png", cv::IMREAD_UNCHANGED);
    const cv::Mat labels = cv::imread(base + "_label.png", cv::IMREAD_UNCHANGED);
    if (depth.type() != CV_16U || labels.type() != CV_8U || depth.size() != labels.size()) continue;
    LabelledScene& scene = scenes.emplace_back();
    depth.convertTo(scene.depth_mm, CV_32F);
    scene.labels = labels;
  }
  return scenes;
}

// The points of each scene; k = 15, levels 0..4.
std::vector<Found> find_objects(const AttentionSettings& settings) {
  WorkerPool pool(2);
  Symmetry3d operator_3d(Symmetry3dParams{}, pool);
  const auto select = make_selector(settings);
  SaliencyMaps maps;
  StageTimes times;
  Attention attention;
  std::vector<Found> all;
  for (const LabelledScene& scene : read_scenes()) {
    const Intrinsics camera{525, 525, 319.5, 239.5, IntrinsicsOrigin::file};
    operator_3d.compute(scene.depth_mm, camera, {}, maps, times);
    select->select(maps.master, scene.depth_mm, camera, attention);
    Found& found = all.emplace_back();
    found.objects = {scene.labels.begin(), scene.labels.end()};
    found.objects.erase(0);
    for (const Fixation& f : attention.fixations) found.labels.push_back(scene.labels(f.row, f.col));
    found.hit = {found.labels.begin(), found.labels.end()};
    found.hit.erase(0);
  }
  return all;
}

HitRatio measure(Selector selector, std::size_t& images) {
  AttentionSettings settings;
  settings.selector = selector;
  settings.fixations = kMost;
  settings.min_confidence = 0;
  HitRatio ratio;
  const std::vector<Found> all = find_objects(settings);
  images = all.size();
  for (const Found& found : all) {
    std::set<int> hit;
    for (std::size_t n = 1; n <= kMost; ++n) {
      if (n <= found.labels.size() && found.labels[n - 1] != 0) hit.insert(found.labels[n - 1]);
      ratio.hit[n - 1] += static_cast<double>(hit.size()) / static_cast<double>(n);
      ratio.bound[n - 1] += static_cast<double>(std::min(n, found.objects.size())) / static_cast<double>(n);
    }
  }
  return ratio;
}

bool have_scenes() { return std::filesystem::exists(kScenes); }

TEST(HitRatio, ProtoFindsTheObjectsOfRealTableScenes) {
  if (!have_scenes()) GTEST_SKIP() << "the real table scenes are not on this machine";
  std::size_t images = 0;
  const HitRatio ratio = measure(Selector::proto, images);
  ASSERT_EQ(images, 15U);
  for (std::size_t n = 0; n < kMost; ++n)
    EXPECT_GE(ratio.hit[n], 0.97 * ratio.bound[n]) << "with " << n + 1 << " fixations";
}

TEST(HitRatio, WtaFindsMostObjectsOfRealTableScenes) {
  if (!have_scenes()) GTEST_SKIP() << "the real table scenes are not on this machine";
  std::size_t images = 0;
  const HitRatio ratio = measure(Selector::wta, images);
  ASSERT_EQ(images, 15U);
  EXPECT_GE(ratio.hit[0], 0.9 * ratio.bound[0]);
  EXPECT_GE(ratio.hit[4], 0.8 * ratio.bound[4]);
  EXPECT_GE(ratio.hit[9], 0.9 * ratio.bound[9]);
}

TEST(HitRatio, ByDefaultThePointsOnRealTableScenesAreItsObjects) {
  if (!have_scenes()) GTEST_SKIP() << "the real table scenes are not on this machine";
  std::size_t points = 0, on_objects = 0, objects = 0, hit = 0;
  for (const Found& found : find_objects({})) {
    points += found.labels.size();
    for (const int label : found.labels) on_objects += label != 0;
    objects += found.objects.size();
    hit += found.hit.size();
  }
  ASSERT_GT(objects, 30U);
  EXPECT_GE(on_objects, 0.98 * static_cast<double>(points));
  EXPECT_GE(hit, 0.97 * static_cast<double>(objects));
}

}  // namespace
}  // namespace saccade
