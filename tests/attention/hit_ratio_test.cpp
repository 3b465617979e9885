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

namespace saccade {
namespace {

constexpr int kMost = 10;
const std::filesystem::path kScenes = std::filesystem::path(SACCADE_SHARED_DIR) / "data/osd_learn";

struct HitRatio {
  std::array<double, kMost> hit{}, bound{};  ///< sums over the images, of n = 1..10
};

void add_image(HitRatio& ratio, const cv::Mat& labels, const std::vector<Fixation>& fixations) {
  std::set<int> objects, found;
  for (int r = 0; r < labels.rows; ++r)
    for (int c = 0; c < labels.cols; ++c)
      if (labels.at<uchar>(r, c) != 0) objects.insert(labels.at<uchar>(r, c));
  for (std::size_t n = 1; n <= kMost; ++n) {
    if (n <= fixations.size()) {
      const int label = labels.at<uchar>(fixations[n - 1].row, fixations[n - 1].col);
      if (label != 0) found.insert(label);
    }
    ratio.hit[n - 1] += static_cast<double>(found.size()) / static_cast<double>(n);
    ratio.bound[n - 1] += static_cast<double>(std::min(n, objects.size())) / static_cast<double>(n);
  }
}

// Every third of the real table scenes, k = 15, levels 0..4.
HitRatio measure(Selector selector, int& images) {
  AttentionSettings settings;
  settings.selector = selector;
  settings.fixations = kMost;
  WorkerPool pool(2);
  Symmetry3d operator_3d(Symmetry3dParams{}, pool);
  const auto select = make_selector(settings);
  SaliencyMaps maps;
  StageTimes times;
  Attention attention;
  HitRatio ratio;
  images = 0;
  for (int frame = 0; frame < 45; frame += 3) {
    const std::string number = std::to_string(10000 + frame).substr(1);
    const std::string base = kScenes / number;
    const cv::Mat depth = cv::imread(base + "_depth.png", cv::IMREAD_UNCHANGED);
    const cv::Mat labels = cv::imread(base + "_label.png", cv::IMREAD_UNCHANGED);
    if (depth.type() != CV_16U || labels.type() != CV_8U || depth.size() != labels.size()) continue;
    cv::Mat1f depth_mm;
    depth.convertTo(depth_mm, CV_32F);
    const Intrinsics camera{525, 525, 319.5, 239.5, IntrinsicsOrigin::file};
    operator_3d.compute(depth_mm, camera, {}, maps, times);
    select->select(maps.master, depth_mm, camera, attention);
    add_image(ratio, labels, attention.fixations);
    ++images;
  }
  return ratio;
}

bool have_scenes() { return std::filesystem::exists(kScenes); }

TEST(HitRatio, ProtoFindsTheObjectsOfRealTableScenes) {
  if (!have_scenes()) GTEST_SKIP() << "the real table scenes are not on this machine";
  int images = 0;
  const HitRatio ratio = measure(Selector::proto, images);
  ASSERT_EQ(images, 15);
  for (std::size_t n = 0; n < kMost; ++n)
    EXPECT_GE(ratio.hit[n], 0.97 * ratio.bound[n]) << "with " << n + 1 << " fixations";
}

TEST(HitRatio, WtaFindsMostObjectsOfRealTableScenes) {
  if (!have_scenes()) GTEST_SKIP() << "the real table scenes are not on this machine";
  int images = 0;
  const HitRatio ratio = measure(Selector::wta, images);
  ASSERT_EQ(images, 15);
  EXPECT_GE(ratio.hit[0], 0.9 * ratio.bound[0]);
  EXPECT_GE(ratio.hit[4], 0.8 * ratio.bound[4]);
  EXPECT_GE(ratio.hit[9], 0.9 * ratio.bound[9]);
}

}  // namespace
}  // namespace saccade
