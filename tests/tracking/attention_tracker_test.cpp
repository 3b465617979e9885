#include "tracking/attention_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "attention/proto.hpp"
#include "followed_frames.hpp"
#include "tracking/frame_follower.hpp"
#include "watched_scene.hpp"

namespace saccade {
namespace {

using Options = WatchedScene::Options;

class AttentionTrackerTest : public ::testing::Test {
 protected:
  AttentionTrackerTest() { cv::setNumThreads(1); }

  void watch(const Options& options, int fixations = 20, const TrackingSettings& settings = {}) {
    scene_.emplace(options);
    tracker_.emplace(fixations, 0, settings);
    follower_.emplace();
  }

  // The attention of frame k.
  const Attention& see(std::int64_t k, double jitter = 0.3, float step = 0.1F) {
    frame_ = &scene_->frame(k);
    attend(scene_->saliency(step, jitter));
    return attention_;
  }

  // The same of the frame made last, with a map of its own.
  void attend(const cv::Mat1f& map) {
    follower_->start(*frame_);
    follower_->wait();
    tracker_->attend(*frame_, map, follower_->surfaces(), follower_->step(), attention_);
  }

  int label_of(const Fixation& fixation) const { return frame_->truth.labels(fixation.row, fixation.col); }

  // Id of the fixation on each label in the frame seen last.
  std::map<int, int> ids() const {
    std::map<int, int> ids;
    for (const Fixation& fixation : attention_.fixations)
      if (const int label = label_of(fixation); label != 0) ids.emplace(label, fixation.id);
    return ids;
  }

  std::optional<WatchedScene> scene_;
  std::optional<AttentionTracker> tracker_;
  std::optional<FrameFollower> follower_;
  const Frame* frame_ = nullptr;
  Attention attention_;
};

// All but what only a sequence has.
void expect_same_fixations(const Attention& a, const Attention& b) {
  ASSERT_EQ(a.fixations.size(), b.fixations.size());
  for (std::size_t i = 0; i < a.fixations.size(); ++i) {
    EXPECT_EQ(a.fixations[i].row, b.fixations[i].row) << i;
    EXPECT_EQ(a.fixations[i].col, b.fixations[i].col) << i;
    EXPECT_EQ(a.fixations[i].confidence, b.fixations[i].confidence) << i;
    EXPECT_EQ(a.fixations[i].saliency, b.fixations[i].saliency) << i;
    EXPECT_EQ(a.fixations[i].proto_object.pixels, b.fixations[i].proto_object.pixels) << i;
    EXPECT_EQ(a.fixations[i].proto_object.centroid_mm, b.fixations[i].proto_object.centroid_mm) << i;
    EXPECT_EQ(a.fixations[i].proto_object.extent_mm, b.fixations[i].proto_object.extent_mm) << i;
  }
  EXPECT_EQ(cv::countNonZero(a.masks != b.masks), 0);
  EXPECT_EQ(a.ended_early, b.ended_early);
}

TEST_F(AttentionTrackerTest, TheFirstFrameIsThatOfTheSelector) {
  for (const char* scene : {"table", "room"})
    for (const int fixations : {5, 40}) {
      watch({.scene = scene}, fixations);
      const Attention& first = see(0);
      Attention alone;
      ProtoSelector(fixations).select(scene_->saliency(0.1F, 0.3), frame_->depth_mm, frame_->intrinsics,
                                      alone);
      expect_same_fixations(first, alone);
      ASSERT_TRUE(first.sequence);
      EXPECT_FALSE(first.sequence->cut);
      EXPECT_EQ(first.sequence->gaze, first.fixations.front().id);
      for (std::size_t i = 0; i < first.fixations.size(); ++i)
        EXPECT_EQ(first.fixations[i].id, static_cast<int>(i) + 1);
    }
}

TEST_F(AttentionTrackerTest, ObjectsKeepIdsAndRanksInNoise) {
  watch({.camera = scene::CameraPath::walk}, 5);
  std::vector<int> first;
  for (const Fixation& fixation : see(0).fixations) first.push_back(fixation.id);
  for (int k = 1; k < 30; ++k) {
    std::vector<int> now;
    for (const Fixation& fixation : see(k).fixations) {
      now.push_back(fixation.id);
      EXPECT_EQ(fixation.age_frames, k + 1);
    }
    EXPECT_EQ(now, first) << k;
  }
}

TEST_F(AttentionTrackerTest, PlacesStayWhereTheyAreInTheWorld) {
  watch({.camera = scene::CameraPath::walk}, 5);
  std::map<int, cv::Point3d> places;
  for (int k = 0; k < 30; ++k)
    for (const Fixation& fixation : see(k).fixations) {
      const cv::Point3d place = *frame_->truth.camera_to_world * cv::Point3d(fixation.position_mm);
      const auto [at, fresh] = places.emplace(fixation.id, place);
      EXPECT_LT(cv::norm(place - at->second), 25) << "id " << fixation.id << " frame " << k;
    }
}

// The map is highest at the top of each object, where noise decides whether a pixel is still the object's.
TEST_F(AttentionTrackerTest, PlacesMoveAwayFromTheBorderOfTheirObject) {
  watch({.size = {640, 480}}, 5);
  const auto is_inside = [&](const Fixation& fixation) {
    const cv::Mat1w& labels = frame_->truth.labels;
    const cv::Rect around = cv::Rect(fixation.col - 2, fixation.row - 2, 5, 5) & cv::Rect({}, labels.size());
    return label_of(fixation) != 0 && cv::countNonZero(labels(around) == label_of(fixation)) == 25;
  };
  std::map<int, cv::Point> first;
  for (int k = 0; k < 45; ++k) {
    frame_ = &scene_->frame(k);
    cv::Mat1f map(frame_->size(), 0.0F);
    for (int label = 1; label <= scene_->objects(); ++label) {
      cv::Mat1b object;
      cv::compare(frame_->truth.labels, label, object, cv::CMP_EQ);
      const cv::Rect box = cv::boundingRect(object);
      object.rowRange(std::min(object.rows, box.y + 3), object.rows).setTo(0);
      map.setTo(1, object);
    }
    attend(map);
    for (const Fixation& fixation : attention_.fixations) {
      if (k == 0) first.emplace(fixation.id, cv::Point(fixation.col, fixation.row));
      if (k >= 20 && first.contains(fixation.id)) {
        EXPECT_TRUE(is_inside(fixation)) << "id " << fixation.id << " frame " << k;
        EXPECT_LE(cv::norm(cv::Point(fixation.col, fixation.row) - first[fixation.id]), 20);
      }
    }
    if (k == 0) {
      EXPECT_FALSE(std::ranges::all_of(attention_.fixations, is_inside));
    }
  }
}

// The map is highest at the outline of each object. The first frame is that of proto.
TEST_F(AttentionTrackerTest, PointsHaveTheirObjectOnAllFourSides) {
  watch({.size = {640, 480}}, 5);
  constexpr int kAway = AttentionTracker::kInside_px;
  int at_border = 0;
  for (int k = 0; k < 10; ++k) {
    frame_ = &scene_->frame(k);
    cv::Mat1f map(frame_->size(), 0.0F);
    for (int label = 1; label <= scene_->objects(); ++label) {
      cv::Mat1b object, middle;
      cv::compare(frame_->truth.labels, label, object, cv::CMP_EQ);
      cv::erode(object, middle, cv::Mat1b::ones(3, 3));
      map.setTo(1, object);
      map.setTo(0, middle);
    }
    attend(map);
    for (const Fixation& fixation : attention_.fixations) {
      const int row = fixation.row, col = fixation.col, own = attention_.masks(row, col);
      const bool inside =
          attention_.masks(row - kAway, col) == own && attention_.masks(row + kAway, col) == own &&
          attention_.masks(row, col - kAway) == own && attention_.masks(row, col + kAway) == own;
      if (k == 0 && !inside) ++at_border;
      EXPECT_TRUE(inside || k == 0) << "id " << fixation.id << " frame " << k;
    }
  }
  EXPECT_GT(at_border, 0);
}

// The saliency at the first object's point is no measure for the others: the point stays while the map
// changes.
TEST_F(AttentionTrackerTest, ConfidenceDoesNotRiseBecauseTheMapFallsAtTheFirstPoint) {
  watch({.size = {640, 480}}, 5);
  std::map<int, float> before;
  cv::Point first;
  for (int k = 0; k < 12; ++k) {
    frame_ = &scene_->frame(k);
    cv::Mat1f map(frame_->size(), 0.0F);
    for (int r = 0; r < map.rows; ++r)
      for (int c = 0; c < map.cols; ++c) {
        const int label = frame_->truth.labels(r, c);
        map(r, c) = label == 0 ? 0 : label == scene_->objects() ? 1 : 0.012F;
        if (k > 0 && std::hypot(r - first.y, c - first.x) < 14) map(r, c) *= 0.01F;
      }
    attend(map);
    if (k == 0) first = {attention_.fixations.front().col, attention_.fixations.front().row};
    for (const Fixation& fixation : attention_.fixations) {
      const auto [at, fresh] = before.emplace(fixation.id, *fixation.confidence);
      EXPECT_LT(*fixation.confidence, at->second + 0.02F) << "id " << fixation.id << " frame " << k;
    }
  }
  EXPECT_GE(before.size(), 3U);
}

TEST_F(AttentionTrackerTest, WhatIsTakenAwayIsGivenUpWithinThreeFrames) {
  watch({.event = scene::EventKind::take});
  for (int k = 0; k < 30; ++k) see(k);
  const int id = ids().at(scene_->label());
  const Fixation* fixation = nullptr;
  for (const Fixation& f : attention_.fixations)
    if (f.id == id) fixation = &f;
  const cv::Point3f place = fixation->position_mm;
  for (int k = 30; k < 60; ++k) {
    see(k);
    if (k < 32) continue;
    for (const Fixation& f : attention_.fixations) EXPECT_NE(f.id, id) << k;
    for (const TrackedObject& object : tracker_->objects().slots())
      EXPECT_FALSE(object.alive && object.id == id) << k;
    EXPECT_NE(attention_.sequence->gaze, id);
  }
  EXPECT_GT(place.z, 0);
}

TEST_F(AttentionTrackerTest, WhatIsPutInIsReportedWithinFiveFramesAndLookedAtWithinASecond) {
  // As many points as there are objects before, so that it must displace one.
  watch({.event = scene::EventKind::add});
  watch({.event = scene::EventKind::add}, scene_->objects() - 1);
  for (int k = 0; k < 30; ++k) see(k);
  EXPECT_FALSE(ids().contains(scene_->label()));
  std::optional<int> reported, looked_at;
  for (int k = 30; k < 60; ++k) {
    see(k);
    const auto now = ids();
    const auto at = now.find(scene_->label());
    if (at == now.end()) continue;
    if (!reported) reported = k;
    if (!looked_at && attention_.sequence->gaze == at->second) looked_at = k;
  }
  ASSERT_TRUE(reported && looked_at);
  EXPECT_LT(*reported, 35);
  EXPECT_LT(*looked_at, 60);
}

TEST_F(AttentionTrackerTest, WhatIsMovedKeepsItsId) {
  for (const std::uint64_t seed : {3u, 4u, 5u}) {
    watch({.seed = seed, .event = scene::EventKind::move});
    for (int k = 0; k < 30; ++k) see(k);
    const int id = ids().at(scene_->label());
    for (int k = 30; k < 75; ++k) see(k);
    EXPECT_EQ(ids().at(scene_->label()), id) << "seed " << seed;
  }
}

TEST_F(AttentionTrackerTest, WhatIsHiddenGetsItsIdBack) {
  watch({.event = scene::EventKind::hide});
  for (int k = 0; k < 30; ++k) see(k);
  const int id = ids().at(scene_->label());
  for (int k = 30; k < 60; ++k) see(k);
  EXPECT_FALSE(ids().contains(scene_->label())) << "the board is before it";
  for (int k = 60; k < 110; ++k) see(k);
  EXPECT_EQ(ids().at(scene_->label()), id);
}

TEST_F(AttentionTrackerTest, OutOfViewAndBackObjectsHaveTheirIds) {
  watch({.scene = "room", .camera = scene::CameraPath::pan}, 30);
  see(0);
  const auto before = ids();
  for (int k = 2; k <= 240; k += 2) see(k);
  const auto after = ids();
  int kept = 0, seen = 0;
  for (const auto& [label, id] : before) {
    if (!after.contains(label)) continue;
    ++seen;
    kept += after.at(label) == id;
  }
  EXPECT_GE(seen, 6);
  EXPECT_GE(kept, seen - 2) << "neighbours that were seen in part may have exchanged theirs";
}

TEST_F(AttentionTrackerTest, AfterACutIdsGoOnCounting) {
  watch({});
  see(0);
  std::set<int> before;
  for (const Fixation& fixation : attention_.fixations) before.insert(fixation.id);
  see(5);
  scene_.emplace(Options{.scene = "room"});
  see(6);
  EXPECT_TRUE(attention_.sequence->cut);
  for (const Fixation& fixation : attention_.fixations) {
    EXPECT_FALSE(before.contains(fixation.id));
    EXPECT_EQ(fixation.age_frames, 1);
  }
}

// Nothing of the scene before is left in it.
TEST_F(AttentionTrackerTest, TheFrameAfterACutIsThatOfTheSelector) {
  watch({});
  for (int k = 0; k < 10; ++k) see(k);
  scene_.emplace(Options{.scene = "room"});
  const Attention& after = see(10);
  ASSERT_TRUE(after.sequence->cut);
  Attention alone;
  ProtoSelector(20).select(scene_->saliency(0.1F, 0.3), frame_->depth_mm, frame_->intrinsics, alone);
  expect_same_fixations(after, alone);
}

TEST_F(AttentionTrackerTest, ASequenceThatBeginsAgainMayHaveItsIdsAgain) {
  watch({});
  see(0);
  const std::map<int, int> before = ids();
  see(1);
  tracker_->number_from(1);
  see(0);
  EXPECT_TRUE(attention_.sequence->cut);
  EXPECT_EQ(ids(), before);
}

// The point stays on one side of the object while the map's hill goes to the other: the map is 0 there.
TEST_F(AttentionTrackerTest, TheSaliencyReportedIsThatOfTheObject) {
  watch({.noise = false}, 1);
  const Fixation first = see(0).fixations.front();
  const int label = label_of(first);
  ASSERT_NE(label, 0);
  for (int k = 1; k < 6; ++k) {
    frame_ = &scene_->frame(k);
    cv::Mat1f map(frame_->size(), 0.0F);
    for (int r = 0; r < map.rows; ++r)
      for (int c = 0; c < map.cols; ++c)
        if (frame_->truth.labels(r, c) == label && std::hypot(r - first.row, c - first.col) > 12)
          map(r, c) = first.saliency;
    attend(map);
    const Fixation& now = attention_.fixations.front();
    ASSERT_EQ(now.id, first.id);
    EXPECT_EQ(map(now.row, now.col), 0) << k;
    EXPECT_NEAR(now.saliency, first.saliency, 0.1F * first.saliency) << k;
  }
}

TEST_F(AttentionTrackerTest, AGapInTimeIsNoCutWhereTheSceneIsTheSame) {
  watch({});
  for (int k = 0; k < 6; ++k) see(k);
  const std::map<int, int> before = ids();
  see(250);  // 8 s later: the sensor was unplugged
  EXPECT_FALSE(attention_.sequence->cut);
  EXPECT_EQ(ids(), before);
}

// The sensor is plugged in again before another table.
TEST_F(AttentionTrackerTest, AfterAGapAnotherSceneIsACutWithNewIds) {
  watch({});
  for (int k = 0; k < 6; ++k) see(k);
  const int next = tracker_->next_id();
  scene_.emplace(Options{.seed = 4});
  const Attention& after = see(250);
  EXPECT_TRUE(after.sequence->cut);
  ASSERT_FALSE(after.fixations.empty());
  for (const Fixation& fixation : after.fixations) EXPECT_GE(fixation.id, next);
}

TEST_F(AttentionTrackerTest, FramesThatWereDroppedAreTimeThatPassed) {
  watch({});
  see(0);
  const auto first = attention_.sequence->gaze;
  see(10);
  EXPECT_EQ(attention_.sequence->gaze, first) << "a third of a second";
  see(16);
  EXPECT_NE(attention_.sequence->gaze, first) << "half a second";
}

TEST_F(AttentionTrackerTest, AJumpOfTheSourceIsACut) {
  watch({});
  see(0);
  see(1);
  frame_ = &scene_->frame(40);
  follower_->start(*frame_, true);
  follower_->wait();
  EXPECT_TRUE(follower_->step().cut);
}

TEST_F(AttentionTrackerTest, ACopyGoesOnFromTheSameMemory) {
  watch({.camera = scene::CameraPath::walk}, 8);
  for (int k = 0; k < 8; ++k) see(k);
  const AttentionTracker before = *tracker_;
  const Attention first = see(8);
  *tracker_ = before;
  tracker_->attend(*frame_, cv::Mat1f(frame_->size(), 1.0F), follower_->surfaces(), follower_->step(),
                   attention_);
  *tracker_ = before;
  tracker_->attend(*frame_, scene_->saliency(0.1F, 0.3), follower_->surfaces(), follower_->step(),
                   attention_);
  EXPECT_EQ(attention_.sequence->gaze, first.sequence->gaze);
  ASSERT_EQ(attention_.fixations.size(), first.fixations.size());
  for (std::size_t i = 0; i < first.fixations.size(); ++i)
    EXPECT_EQ(attention_.fixations[i].id, first.fixations[i].id);
}

TEST_F(AttentionTrackerTest, WithoutEvidenceObjectsAndTheirOrderStay) {
  watch({}, 8);
  for (int k = 0; k < 8; ++k) see(k);
  const std::map<int, int> before = ids();
  tracker_->forget_evidence();
  tracker_->configure(3, 0, {});
  see(8);
  ASSERT_EQ(attention_.fixations.size(), 3U);
  for (const auto& [label, id] : ids()) EXPECT_EQ(id, before.at(label));
}

// The two sides of a valley are two objects by their shape. Colours: of the left and the right side. The
// right side is salient from frame `both_from` on.
std::vector<Attention> look_at_valley(const cv::Vec3b& left, const cv::Vec3b& right, int frames,
                                      int both_from = 0) {
  const cv::Rect thing(120, 80, 80, 80);
  Frame frame;
  frame.depth_mm = cv::Mat1f(240, 320, 3000.0F);
  frame.colour = cv::Mat3b(240, 320, cv::Vec3b(128, 128, 128));
  frame.intrinsics = Intrinsics::guess_for(frame.size());
  cv::Mat1f left_map(240, 320, 0.0F), map(240, 320, 0.0F);
  for (int r = thing.y; r < thing.br().y; ++r)
    for (int c = thing.x; c < thing.br().x; ++c) {
      frame.depth_mm(r, c) = static_cast<float>(1000 - 1.5 * std::abs(c - 160));
      frame.colour(r, c) = c < 160 ? left : right;
      const auto hill = [&](int middle) {
        return std::max(0.0F, 1 - 0.125F * static_cast<float>(std::hypot(r - 120, c - middle)));
      };
      left_map(r, c) = hill(135);
      map(r, c) = hill(135) + hill(185);
    }
  FollowedFrames followed;
  std::vector<Attention> all;
  for (int k = 0; k < frames; ++k) {
    all.push_back(followed.attend(frame, k < both_from ? left_map : map));
    all.back().masks = all.back().masks.clone();
  }
  return all;
}

TEST(AttentionTracker, PartsOfOneThingHaveOneFixationAndOneMask) {
  const auto frames = look_at_valley({60, 90, 130}, {60, 90, 130}, 5);
  ASSERT_EQ(frames.front().fixations.size(), 2U) << "as in a single frame";
  ASSERT_EQ(frames.back().fixations.size(), 1U);
  const Fixation& thing = frames.back().fixations.front();
  EXPECT_EQ(thing.id, 1);
  EXPECT_GT(thing.proto_object.pixels, 1.8 * frames.front().fixations.front().proto_object.pixels);
  EXPECT_EQ(cv::countNonZero(frames.back().masks), thing.proto_object.pixels);
}

TEST(AttentionTracker, AnotherColourIsAnotherFixation) {
  for (const Attention& attention : look_at_valley({60, 90, 130}, {60, 140, 60}, 5))
    EXPECT_EQ(attention.fixations.size(), 2U);
}

TEST(AttentionTracker, WhatIsFoundToBeAPartIsNeverReported) {
  const cv::Vec3b brown(60, 90, 130), green(60, 140, 60);
  for (const Attention& attention : look_at_valley(brown, brown, 20, 3))
    EXPECT_EQ(attention.fixations.size(), 1U);
  EXPECT_EQ(look_at_valley(brown, green, 20, 3).back().fixations.size(), 2U);
}

// A board that is large and of one colour, with a patch of another colour on it that has no edge in depth.
TEST(AttentionTracker, WhatOnlyColourShowsHasItsOwnFixation) {
  const cv::Rect board(100, 80, 120, 72), patch(164, 92, 40, 40);
  Frame frame;
  frame.depth_mm = cv::Mat1f(240, 320, 3000.0F);
  frame.depth_mm(board) = 2000;
  frame.colour = cv::Mat3b(240, 320, cv::Vec3b(128, 128, 128));
  frame.colour(board) = cv::Vec3b(60, 90, 130);
  frame.colour(patch) = cv::Vec3b(60, 140, 60);
  frame.intrinsics = Intrinsics::guess_for(frame.size());
  cv::Mat1f map(240, 320, 0.0F);
  for (int r = board.y; r < board.br().y; ++r)
    for (int c = board.x; c < board.br().x; ++c)
      for (const int middle : {120, 184})
        map(r, c) += std::max(0.0F, 1 - 0.1F * static_cast<float>(std::hypot(r - 112, c - middle)));
  FollowedFrames followed;
  ASSERT_EQ(followed.attend(frame, map).fixations.size(), 1U) << "as in a single frame";
  for (int k = 2; k < 5; ++k) followed.attend(frame, map);
  const Attention& attention = followed.attend(frame, map);
  ASSERT_EQ(attention.fixations.size(), 2U);
  for (const Fixation& fixation : attention.fixations) {
    const bool on_patch = patch.contains({fixation.col, fixation.row});
    EXPECT_NEAR(fixation.proto_object.pixels, on_patch ? patch.area() : board.area() - patch.area(), 300);
  }
  EXPECT_NE(attention.masks(112, 120), attention.masks(112, 184));
}

TEST(AttentionTracker, NeedsAFixation) { EXPECT_THROW(AttentionTracker(0, 0, {}), std::invalid_argument); }

}  // namespace
}  // namespace saccade
