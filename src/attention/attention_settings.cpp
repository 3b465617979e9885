#include "attention/attention_settings.hpp"

namespace saccade {

std::vector<SettingOf<AttentionSettings>> attention_setting_specs() {
  using S = AttentionSettings;
  return {
      enum_setting<S>("selector",
                      "how attention points are chosen: proto (one per object) or wta (the paper's "
                      "winner-take-all network)",
                      &S::selector, {"proto", "wta"}),
      number_setting<S>("fixations", "N", "greatest number of attention points per frame, 1..1000",
                        &S::fixations, 1, 1000),
      number_setting<S>("min-confidence", "P",
                        "least probability that a point of proto lies on an object, 0..1; points with less "
                        "are not reported, 0 = all are",
                        &S::min_confidence, 0, 1),
      number_setting<S>("foa", "PX",
                        "diameter of the focus of attention of wta, in pixels of the image, 1..1000", &S::foa,
                        1, 1000),
  };
}

}  // namespace saccade
