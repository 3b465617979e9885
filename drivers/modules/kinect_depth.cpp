#include "drivers/modules/kinect_depth.hpp"

#include <cmath>

namespace saccade {

double kinect_depth_mm(int raw, const KinectGeometry& geometry) {
  const double shift_px = raw / 4.0 - geometry.constant_shift - 3.0 / 8;
  const double shift_cm = shift_px * geometry.reference_pixel_cm;
  return 10 * geometry.reference_distance_cm * geometry.baseline_cm / (geometry.baseline_cm - shift_cm);
}

std::array<std::uint16_t, 2048> kinect_depth_table(const KinectGeometry& geometry) {
  constexpr int kNoReading = 2047;
  std::array<std::uint16_t, 2048> table{};
  for (int raw = 0; raw < kNoReading; ++raw) {
    const double mm = std::round(kinect_depth_mm(raw, geometry));
    if (mm >= 1 && mm <= kKinectLargestDepth_mm)
      table[static_cast<std::size_t>(raw)] = static_cast<std::uint16_t>(mm);
  }
  return table;
}

double kinect_focal_px(const KinectGeometry& geometry) {
  return geometry.reference_distance_cm / geometry.reference_pixel_cm / 2;
}

std::uint64_t KinectClock::microseconds(std::uint32_t ticks) {
  constexpr std::uint64_t kTicksPerMicrosecond = 60, kRoomBefore = std::uint64_t{1} << 32;
  if (!started_) total_ = kRoomBefore + ticks;
  started_ = true;
  const auto step = static_cast<std::int32_t>(ticks - static_cast<std::uint32_t>(total_));
  total_ += static_cast<std::uint64_t>(static_cast<std::int64_t>(step));
  return total_ / kTicksPerMicrosecond;
}

}  // namespace saccade
