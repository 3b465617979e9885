#include "ui/session/sensor_settings_sync.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

constexpr std::nullopt_t kNone = std::nullopt;
// registration, mirror, automatic exposure, exposure, automatic white balance
const SensorValues kMirror{kNone, true, kNone, kNone, kNone}, kAutomatic{kNone, kNone, true, kNone, kNone},
    kByHand{kNone, kNone, false, kNone, kNone}, kDevice{true, false, true, 40, true};

TEST(SensorSettingsSync, RequestedValuesMakeARoundTrip) {
  const SensorSettings before;
  SensorSettings after = before;
  store_request(after, kMirror, kDevice);
  EXPECT_EQ(changed_values(before, after), kMirror);
  EXPECT_EQ(changed_values(after, before).mirror, false) << "undone";

  after = before;
  const SensorValues two{false, kNone, kNone, kNone, false};
  store_request(after, two, kDevice);
  EXPECT_EQ(changed_values(before, after), two);
  EXPECT_EQ(changed_values(after, after), SensorValues{});
}

TEST(SensorSettingsSync, ExposureStaysAsItIsWhenItIsNoLongerAutomatic) {
  SensorSettings settings;
  store_request(settings, kByHand, kDevice);
  EXPECT_EQ(settings.exposure, 40);
  EXPECT_EQ(changed_values({}, settings), (SensorValues{kNone, kNone, false, 40, kNone}));
  store_request(settings, {kNone, kNone, kNone, 55, kNone}, kDevice);
  EXPECT_EQ(settings.exposure, 55);
  SensorSettings automatic = settings;
  store_request(automatic, kAutomatic, kDevice);
  EXPECT_EQ(changed_values(settings, automatic), kAutomatic);

  settings = {};
  store_request(settings, kByHand, kAutomatic);
  EXPECT_FALSE(settings.exposure) << "the device does not say any";
}

TEST(SensorSettingsSync, TheModeIsForTheNextOpening) {
  SensorSettings other;
  other.mode = SensorMode{320, 240, 30};
  EXPECT_EQ(changed_values({}, other), SensorValues{});
}

}  // namespace
}  // namespace saccade
