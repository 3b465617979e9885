#include "attention/proto.hpp"

#include <cmath>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "table_scene.hpp"

namespace saccade {
namespace {

using testing::HasSubstr;

struct Measured {
  double both = 0, mask = 0, label = 0;
  cv::Vec3d sum;
  cv::Vec3d low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};

  double overlap() const { return both / (mask + label - both); }
};

// The mask of `rank` beside the pixels of `label`, and the exact shape of what is visible of the thing.
Measured measure(const TableScene& scene, const Attention& attention, int rank, int label) {
  Measured m;
  for (int r = 0; r < scene.labels.rows; ++r)
    for (int c = 0; c < scene.labels.cols; ++c) {
      const bool masked = attention.masks(r, c) == rank, labelled = scene.labels(r, c) == label;
      m.mask += masked, m.label += labelled, m.both += masked && labelled;
      if (!labelled) continue;
      const cv::Vec3d p = scene.points_mm(r, c);
      m.sum += p;
      for (int k = 0; k < 3; ++k) m.low[k] = std::min(m.low[k], p[k]), m.high[k] = std::max(m.high[k], p[k]);
    }
  return m;
}

void expect_proto_object(const TableScene& scene, const Attention& attention, int rank, int label) {
  const Fixation& fixation = attention.fixations[static_cast<std::size_t>(rank - 1)];
  EXPECT_EQ(scene.labels(fixation.row, fixation.col), label);
  EXPECT_EQ(attention.masks(fixation.row, fixation.col), rank);
  const Measured m = measure(scene, attention, rank, label);
  EXPECT_EQ(fixation.proto_object.pixels, m.mask);
  EXPECT_GT(m.overlap(), 0.85) << "rank " << rank;
  const cv::Vec3d centroid = m.sum / m.label;
  const cv::Point3f found = fixation.proto_object.centroid_mm, extent = fixation.proto_object.extent_mm;
  EXPECT_LT(cv::norm(centroid - cv::Vec3d(found.x, found.y, found.z)), 8) << "rank " << rank;
  EXPECT_NEAR(extent.x, m.high[0] - m.low[0], 15);
  EXPECT_NEAR(extent.y, m.high[1] - m.low[1], 15);
  EXPECT_NEAR(extent.z, m.high[2] - m.low[2], 25);  // the rim of a ball is steep
}

TEST(ProtoSelector, TwoBoxesAndABallAreOneFixationEach) {
  const TableScene scene =
      look_at_table({box(20, 200, 160, 100, 120), box(-10, -100, 120, 140, 60), ball(250, 60, 60)});
  const cv::Point a = middle_of(scene.labels, 1), b = middle_of(scene.labels, 2),
                  c = middle_of(scene.labels, 3);
  // Two hills on the first box: the second of them must not be a fixation.
  const cv::Mat1f map = hills(scene.labels.size(), {{a, 3}, {a + cv::Point(20, 10), 2.9F}, {b, 2}, {c, 1}});
  ProtoSelector selector(10);
  Attention attention;
  selector.select(map, scene.depth_mm, scene.camera, attention);
  ASSERT_GE(attention.fixations.size(), 3U);
  for (int rank = 1; rank <= 3; ++rank) expect_proto_object(scene, attention, rank, rank);
  for (std::size_t k = 3; k < attention.fixations.size(); ++k)
    EXPECT_EQ(scene.labels(attention.fixations[k].row, attention.fixations[k].col), 0) << k;
}

TEST(ProtoSelector, TouchingBoxesOfDifferentHeightsAreTwo) {
  const TableScene scene = look_at_table({box(-60, 0, 120, 100, 80), box(60, 40, 120, 100, 150)});
  const cv::Mat1f map =
      hills(scene.labels.size(), {{middle_of(scene.labels, 1), 2}, {middle_of(scene.labels, 2), 1}});
  ProtoSelector selector(2);
  Attention attention;
  selector.select(map, scene.depth_mm, scene.camera, attention);
  ASSERT_EQ(attention.fixations.size(), 2U);
  EXPECT_TRUE(attention.ended_early.empty());
  for (int rank = 1; rank <= 2; ++rank) expect_proto_object(scene, attention, rank, rank);
}

// The second and the third box have nearly the same saliency; the third is far from the first fixation.
TEST(ProtoSelector, TheNextPointGoesElsewhereFirst) {
  const TableScene scene =
      look_at_table({box(-250, 100, 80, 80, 80), box(-130, 100, 80, 80, 100), box(250, 100, 80, 80, 80)});
  const auto second_fixation = [&](float nearer) {
    const cv::Mat1f map = hills(scene.labels.size(), {{middle_of(scene.labels, 1), 2},
                                                      {middle_of(scene.labels, 2), nearer},
                                                      {middle_of(scene.labels, 3), 1}});
    ProtoSelector selector(3);
    Attention attention;
    selector.select(map, scene.depth_mm, scene.camera, attention);
    EXPECT_EQ(scene.labels(attention.fixations.at(0).row, attention.fixations.at(0).col), 1);
    return scene.labels(attention.fixations.at(1).row, attention.fixations.at(1).col);
  };
  EXPECT_EQ(second_fixation(1.05F), 3);
  EXPECT_EQ(second_fixation(1.9F), 2);  // it is a discount and no ban
}

TEST(ProtoSelector, AFixationOnTheTableTakesADiscOfItOnly) {
  const TableScene scene = look_at_table({box(0, 150, 100, 100, 100)});
  const cv::Mat1f map = hills(scene.labels.size(), {{{200, 380}, 1}});
  ProtoSelector selector(1);
  Attention attention;
  selector.select(map, scene.depth_mm, scene.camera, attention);
  ASSERT_EQ(attention.fixations.size(), 1U);
  EXPECT_LE(attention.fixations[0].proto_object.pixels, 81 * 81);
  EXPECT_GT(attention.fixations[0].proto_object.pixels, 1000);
}

TEST(ProtoSelector, AThingComesBeforeTheTableUnderTheSameSaliency) {
  const TableScene scene = look_at_table({box(0, 150, 100, 100, 100)});
  const cv::Point thing = middle_of(scene.labels, 1);
  const cv::Mat1f map = hills(scene.labels.size(), {{thing, 1}, {{120, 400}, 5}});
  ProtoSelector selector(2);
  Attention attention;
  selector.select(map, scene.depth_mm, scene.camera, attention);
  ASSERT_EQ(attention.fixations.size(), 2U);
  EXPECT_EQ(scene.labels(attention.fixations[0].row, attention.fixations[0].col), 1);
  EXPECT_EQ(scene.labels(attention.fixations[1].row, attention.fixations[1].col), 0);
}

// A board with a window before a wall. The window shows a piece of the wall, which owns none of its border.
TEST(ProtoSelector, AThingInFrontComesBeforeAPieceOfItsBackground) {
  cv::Mat1f depth(480, 640, 2000.0F);
  depth(cv::Rect(100, 100, 200, 200)) = 1200.0F;
  depth(cv::Rect(180, 180, 40, 40)) = 2000.0F;
  depth(cv::Rect(420, 200, 60, 60)) = 1200.0F;
  const auto first_fixation = [&](float window) {
    const cv::Mat1f map = hills(depth.size(), {{{200, 200}, window}, {{450, 230}, 1}});
    ProtoSelector selector(1);
    Attention attention;
    selector.select(map, depth, Intrinsics::guess_for(depth.size()), attention);
    return depth(attention.fixations.at(0).row, attention.fixations.at(0).col);
  };
  EXPECT_EQ(first_fixation(5), 1200);
  EXPECT_EQ(first_fixation(200), 2000);  // it is a weight and no ban
}

TEST(ProtoSelector, LeavesOutDoubtfulPointsAndSaysHowMany) {
  const TableScene scene =
      look_at_table({box(20, 200, 160, 100, 120), box(-10, -100, 120, 140, 60), ball(250, 60, 60)});
  const cv::Mat1f map = hills(scene.labels.size(), {{middle_of(scene.labels, 1), 3},
                                                    {{120, 400}, 200},  // on the table
                                                    {middle_of(scene.labels, 2), 2},
                                                    {middle_of(scene.labels, 3), 1}});
  ProtoSelector all(10), sure(10, 0.5);
  Attention a, b;
  all.select(map, scene.depth_mm, scene.camera, a);
  sure.select(map, scene.depth_mm, scene.camera, b);
  ASSERT_EQ(b.fixations.size(), 3U);
  ASSERT_GT(a.fixations.size(), 3U);
  std::size_t k = 0;
  for (const Fixation& f : a.fixations) {
    const bool on_thing = scene.labels(f.row, f.col) != 0;
    ASSERT_TRUE(f.confidence);
    EXPECT_EQ(is_doubtful(f), !on_thing) << *f.confidence;
    if (!on_thing) continue;
    EXPECT_EQ(b.fixations[k].row, f.row);
    EXPECT_EQ(b.fixations[k].col, f.col);
    EXPECT_EQ(b.fixations[k].confidence, f.confidence);
    EXPECT_EQ(b.masks(f.row, f.col), ++k);
  }
  EXPECT_THAT(b.ended_early,
              HasSubstr(std::to_string(a.fixations.size() - 3) + " points with a confidence below 0.5"));
}

TEST(ProtoSelector, EndsWithAReasonWhenThereIsNothing) {
  ProtoSelector selector(5);
  Attention attention;
  const Intrinsics camera = Intrinsics::guess_for({64, 48});
  const cv::Mat1f flat(48, 64, 1.0F), zero(48, 64, 0.0F), depth(48, 64, 1000.0F);
  selector.select(zero, depth, camera, attention);
  EXPECT_TRUE(attention.fixations.empty());
  EXPECT_THAT(attention.ended_early, HasSubstr("nothing salient"));
  selector.select(flat, zero, camera, attention);
  EXPECT_TRUE(attention.fixations.empty());
  EXPECT_THAT(attention.ended_early, HasSubstr("depth"));
  EXPECT_EQ(cv::countNonZero(attention.masks), 0);
}

TEST(ProtoSelector, AFlatMapGivesDifferentPixelsUntilNothingIsLeft) {
  ProtoSelector selector(1000);
  Attention attention;
  for (const cv::Size size : {cv::Size(8, 8), cv::Size(1, 1), cv::Size(67, 45), cv::Size(320, 240)}) {
    const cv::Mat1f flat(size, 1.0F), depth(size, 1000.0F);
    selector.select(flat, depth, Intrinsics::guess_for(size), attention);
    std::set<std::pair<int, int>> seen;
    for (const Fixation& f : attention.fixations) EXPECT_TRUE(seen.insert({f.row, f.col}).second);
    EXPECT_GE(seen.size(), 1U);
    EXPECT_FALSE(attention.ended_early.empty());
  }
}

TEST(ProtoSelector, NoiseAndHolesGiveFiniteNumbersAndOnlyPixelsWithDepth) {
  std::mt19937 random(11);
  cv::Mat1f depth(120, 163), map(120, 163);
  for (float& z : depth) z = random() % 4 == 0 ? 0.0F : static_cast<float>(random() % 10000);
  for (float& s : map) s = static_cast<float>(random() % 1000) / 250;
  ProtoSelector selector(50);
  Attention attention;
  selector.select(map, depth, Intrinsics::guess_for(depth.size()), attention);
  EXPECT_GE(attention.fixations.size(), 3U);
  EXPECT_FALSE(attention.ended_early.empty());
  int rank = 0;
  for (const Fixation& f : attention.fixations) {
    ++rank;
    EXPECT_GT(depth(f.row, f.col), 0);
    EXPECT_EQ(f.position_mm.z, depth(f.row, f.col));
    EXPECT_EQ(attention.masks(f.row, f.col), rank);
    EXPECT_TRUE(std::isfinite(f.proto_object.centroid_mm.x + f.proto_object.extent_mm.x));
  }
}

TEST(ProtoSelector, TheSameFrameGivesTheSameWhateverCameBefore) {
  const TableScene one = look_at_table({box(-100, 0, 120, 100, 80), ball(120, 40, 70)}, {320, 240});
  const TableScene two = look_at_table({box(100, 100, 60, 60, 200)}, {163, 120});
  const cv::Mat1f map = hills(one.labels.size(), {{{150, 100}, 1}, {{200, 120}, 1}, {{40, 200}, 1}});
  ProtoSelector fresh(10), used(10);
  Attention a, b;
  fresh.select(map, one.depth_mm, one.camera, a);
  used.select(cv::Mat1f(two.labels.size(), 1.0F), two.depth_mm, two.camera, b);
  used.select(map, one.depth_mm, one.camera, b);
  ASSERT_EQ(a.fixations.size(), b.fixations.size());
  for (std::size_t k = 0; k < a.fixations.size(); ++k) {
    EXPECT_EQ(a.fixations[k].row, b.fixations[k].row);
    EXPECT_EQ(a.fixations[k].col, b.fixations[k].col);
    EXPECT_EQ(a.fixations[k].proto_object.pixels, b.fixations[k].proto_object.pixels);
    EXPECT_EQ(a.fixations[k].proto_object.centroid_mm, b.fixations[k].proto_object.centroid_mm);
  }
  EXPECT_EQ(cv::countNonZero(a.masks != b.masks), 0);
}

TEST(SmoothCells, IsTheMeanThenTheBinomialBothWays) {
  std::mt19937 random(3);
  cv::Mat1f map(38, 30);
  for (float& s : map) s = static_cast<float>(random() % 1000) / 250;
  std::vector<float> scratch, smooth;
  smooth_cells(map, scratch, smooth);
  const int rows = 10, cols = 8;
  ASSERT_EQ(smooth.size(), 80U);
  cv::Mat1d mean(rows, cols, 0.0);
  for (int r = 0; r < map.rows; ++r)
    for (int c = 0; c < map.cols; ++c) mean(r / 4, c / 4) += static_cast<double>(map(r, c)) / 16;
  const double binomial[] = {1, 8, 28, 56, 70, 56, 28, 8, 1};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      double sum = 0;
      for (int v = -4; v <= 4; ++v)
        for (int u = -4; u <= 4; ++u)
          if (r + v >= 0 && r + v < rows && c + u >= 0 && c + u < cols)
            sum += binomial[v + 4] * binomial[u + 4] / 65536 * mean(r + v, c + u);
      EXPECT_NEAR(smooth[static_cast<std::size_t>(r * cols + c)], sum, 1e-5);
    }
}

TEST(MakeSelector, GivesTheOneAskedFor) {
  const TableScene scene = look_at_table({box(0, 0, 120, 100, 120)}, {160, 120});
  const cv::Mat1f map = hills(scene.labels.size(), {{middle_of(scene.labels, 1), 1}});
  AttentionSettings settings;
  settings.fixations = 1;
  Attention attention;
  make_selector(settings)->select(map, scene.depth_mm, scene.camera, attention);
  EXPECT_GT(attention.fixations.at(0).proto_object.pixels, 0);
  settings.selector = Selector::wta;
  make_selector(settings)->select(map, scene.depth_mm, scene.camera, attention);
  EXPECT_EQ(attention.fixations.at(0).proto_object.pixels, 0);
}

}  // namespace
}  // namespace saccade
