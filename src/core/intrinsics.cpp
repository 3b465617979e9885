#include "core/intrinsics.hpp"

#include <cmath>

namespace saccade {

std::string_view to_string(IntrinsicsOrigin origin) {
  switch (origin) {
    case IntrinsicsOrigin::sensor:
      return "sensor";
    case IntrinsicsOrigin::file:
      return "file";
    case IntrinsicsOrigin::option:
      return "option";
    case IntrinsicsOrigin::guess:
      return "guess";
  }
  return "guess";
}

bool Intrinsics::valid() const {
  return std::isfinite(fx) && std::isfinite(fy) && std::isfinite(cx) && std::isfinite(cy) && fx > 0 && fy > 0;
}

Intrinsics Intrinsics::at_level(int level) const {
  const double scale = std::ldexp(1.0, -level);
  return {fx * scale, fy * scale, cx * scale, cy * scale, origin};
}

Intrinsics Intrinsics::guess_for(cv::Size size) {
  // The division comes last: 525 * 8 / 640 is exact, 525 * (8 / 640.0) need not be.
  const double focal_px = 525.0 * size.width / 640;
  return {focal_px, focal_px, (size.width - 1) / 2.0, (size.height - 1) / 2.0, IntrinsicsOrigin::guess};
}

Intrinsics Intrinsics::from_field_of_view(cv::Size size, double horizontal_rad, double vertical_rad,
                                          IntrinsicsOrigin origin) {
  return {size.width / 2.0 / std::tan(horizontal_rad / 2), size.height / 2.0 / std::tan(vertical_rad / 2),
          (size.width - 1) / 2.0, (size.height - 1) / 2.0, origin};
}

}  // namespace saccade
