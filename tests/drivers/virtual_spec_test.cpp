#include "drivers/modules/virtual_spec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

std::string complaint(const std::string& text) {
  try {
    parse_virtual(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
    return error.what();
  }
  return "";
}

TEST(VirtualSpec, IsASourceAlone) {
  for (const std::string source :
       {"recordings/table.oni", "synthetic:table", "synthetic:room?seed=3&noise=kinect"}) {
    const VirtualSpec spec = parse_virtual(source);
    EXPECT_EQ(spec.source, source);
    EXPECT_EQ(spec.loss_after, std::nullopt);
    EXPECT_EQ(spec.back_after, std::nullopt);
    EXPECT_EQ(spec.rate_hz, std::nullopt);
    EXPECT_EQ(spec.late, milliseconds(0));
    EXPECT_FALSE(spec.ignores_settings);
  }
}

TEST(VirtualSpec, RelativePathsAreSeenFromAFolder) {
  EXPECT_EQ(seen_from("/home/me", "recordings/table.oni"), "/home/me/recordings/table.oni");
  EXPECT_EQ(seen_from("/home/me", "../a b"), "/home/a b");
  for (const char* source : {"/data/a.oni", "synthetic:table", "v4l2:0", "openni2:uri"})
    EXPECT_EQ(seen_from("/home/me", source), source);
}

TEST(VirtualSpec, FaultsFollowTheSource) {
  for (const char separator : {'?', '&'}) {
    const VirtualSpec spec = parse_virtual(std::string("a b.oni") + separator +
                                           "loss_after=50&loss=silent&back_after_ms=800&late_ms=10&stall_ms="
                                           "20&stall_after=7&short_frame=3&rate=12.5&back_at=9&"
                                           "ignores_settings=1");
    EXPECT_EQ(spec.source, "a b.oni");
    EXPECT_EQ(spec.loss_after, 50);
    EXPECT_EQ(spec.loss, VirtualSpec::Loss::silent);
    EXPECT_EQ(spec.back_after, milliseconds(800));
    EXPECT_EQ(spec.late, milliseconds(10));
    EXPECT_EQ(spec.stall, milliseconds(20));
    EXPECT_EQ(spec.stall_after, 7);
    EXPECT_EQ(spec.short_frame, 3);
    EXPECT_EQ(spec.rate_hz, 12.5);
    EXPECT_EQ(spec.back_at, 9);
    EXPECT_TRUE(spec.ignores_settings);
  }
}

TEST(VirtualSpec, SyntheticSourcesKeepTheirKeys) {
  const VirtualSpec spec =
      parse_virtual("synthetic:table?loss=state&seed=7&loss_after=5&camera=orbit&rate=60");
  EXPECT_EQ(spec.source, "synthetic:table?seed=7&camera=orbit");
  EXPECT_EQ(spec.loss, VirtualSpec::Loss::state);
  EXPECT_EQ(spec.loss_after, 5);
  EXPECT_EQ(spec.rate_hz, 60);
}

TEST(VirtualSpec, NamesMistakes) {
  EXPECT_THAT(complaint("a.oni?lossafter=3"), HasSubstr("unknown key 'lossafter'"));
  EXPECT_THAT(complaint("a.oni?lossafter=3"), HasSubstr("loss_after"));
  EXPECT_THAT(complaint("a.oni?"), HasSubstr("unknown key ''"));
  EXPECT_THAT(complaint("a.oni?loss_after=3&loss_after=4"), HasSubstr("given twice"));
  for (const char* pair :
       {"loss_after=0", "loss_after=3x", "loss_after", "loss=lost", "back_after_ms=-1", "back_at=-1",
        "rate=0", "rate=nan", "short_frame=0", "ignores_settings=2", "late_ms=1.5"})
    EXPECT_THAT(complaint(std::string("a.oni&") + pair), HasSubstr("bad value")) << pair;
  EXPECT_THAT(complaint("?loss=event"), HasSubstr("no source"));
  EXPECT_THAT(complaint(""), HasSubstr("no source"));
}

}  // namespace
}  // namespace saccade
