#include "tracking/track_log.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tracking/tracking_settings.hpp"

namespace saccade {
namespace {

Attention attention_with(const std::vector<int>& ids, std::optional<int> gaze, bool cut = false) {
  Attention attention;
  for (const int id : ids) {
    attention.fixations.emplace_back();
    attention.fixations.back().id = id;
    attention.fixations.back().world_mm = {static_cast<float>(id), 0, 0};
  }
  attention.sequence = SequenceState{gaze, cut, {}};
  return attention;
}

TEST(TrackLog, ListsTheLifeOfEachObject) {
  TrackLog log;
  log.add(0, {});
  EXPECT_TRUE(log.empty()) << "without a sequence there is nothing to log";
  log.add(10, attention_with({1, 2}, 1));
  log.add(12, attention_with({2, 1}, 1));
  log.add(14, attention_with({2}, 2));
  log.add(16, attention_with({1, 2}, 1));
  log.add(18, attention_with({3}, 3, true));
  ASSERT_EQ(log.tracks().size(), 3U);
  const TrackLog::Track& first = log.tracks().at(1);
  EXPECT_EQ(first.first_frame, 10);
  EXPECT_EQ(first.last_frame, 16);
  EXPECT_EQ(first.frames, 3);
  EXPECT_EQ(first.looks, 2) << "a look that lasts several frames is one";
  EXPECT_EQ(first.world_mm.x, 1);
  EXPECT_EQ(log.cuts(), 1);
  EXPECT_EQ(log.unlisted(), 0);
}

TEST(TrackLog, CountsObjectsBeyondTheList) {
  TrackLog log;
  for (int id = 1; id <= static_cast<int>(TrackLog::kMostTracks) + 5; ++id) {
    log.add(id, attention_with({id}, {}));
    log.add(id, attention_with({id}, {}));
  }
  EXPECT_EQ(log.tracks().size(), TrackLog::kMostTracks);
  EXPECT_EQ(log.unlisted(), 5);
}

TEST(TrackingSettings, AutoFollowsTheSource) {
  TrackingSettings settings;
  EXPECT_TRUE(tracks(settings, Selector::proto, true, "a.oni"));
  EXPECT_FALSE(tracks(settings, Selector::proto, false, "stills"));
  EXPECT_FALSE(tracks(settings, Selector::wta, true, "a.oni"));
  settings.tracking = Tracking::off;
  EXPECT_FALSE(tracks(settings, Selector::proto, true, "a.oni"));
  settings.tracking = Tracking::on;
  EXPECT_TRUE(tracks(settings, Selector::proto, false, "stills"));
  EXPECT_THROW((void)tracks(settings, Selector::wta, true, "a.oni"), Error);
}

}  // namespace
}  // namespace saccade
