#include "pipeline/frame_settings.hpp"

#include <algorithm>
#include <array>

namespace saccade {
namespace {

using S = FrameSettings;

void parse_intrinsics(S& s, const std::string& text) {
  if (text.empty()) return s.intrinsics.reset();
  const std::string expected = "fx,fy,cx,cy in pixels, finite numbers, fx and fy above 0";
  const auto parts = split_list(text);
  if (parts.size() != 4) throw std::invalid_argument(expected);
  constexpr double kHuge = 1e6;
  std::array<double, 4> v{};
  for (std::size_t i = 0; i < 4; ++i) v[i] = parse_number(parts[i], -kHuge, kHuge, expected);
  const Intrinsics camera{v[0], v[1], v[2], v[3], IntrinsicsOrigin::option};
  if (!camera.valid()) throw std::invalid_argument(expected);
  s.intrinsics = camera;
}

std::string print_intrinsics(const S& s) {
  if (!s.intrinsics) return "";
  const Intrinsics& camera = *s.intrinsics;
  return print_number(camera.fx) + "," + print_number(camera.fy) + "," + print_number(camera.cx) + "," +
         print_number(camera.cy);
}

}  // namespace

std::vector<SettingOf<S>> frame_setting_specs() {
  constexpr std::int64_t kMany = 1'000'000'000;
  return {
      number_setting<S>("frames", "N", "stop after N frames; 0 = do not stop", &S::frames, 0, kMany),
      number_setting<S>("start", "N", "index of the first frame, from 0", &S::start, 0, kMany),
      number_setting<S>("every", "N", "use every N-th frame, from 1", &S::every, 1, kMany),
      {"intrinsics", "FX,FY,CX,CY", "camera in pixels, instead of the source's", parse_intrinsics,
       print_intrinsics},
  };
}

std::int64_t selected_frames(const FrameSettings& settings, std::int64_t count) {
  const std::int64_t all =
      std::max<std::int64_t>(0, (count - settings.start + settings.every - 1) / settings.every);
  return settings.frames > 0 ? std::min(all, settings.frames) : all;
}

}  // namespace saccade
