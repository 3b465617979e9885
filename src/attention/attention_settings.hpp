#pragma once

#include <vector>

#include "attention/confidence.hpp"
#include "core/setting.hpp"

namespace saccade {

enum class Selector {
  proto,  ///< one point per proto-object (attention/proto.hpp)
  wta,    ///< the paper's winner-take-all network (attention/wta.hpp)
};

/// How attention points are chosen.
struct AttentionSettings {
  Selector selector = Selector::proto;
  int fixations = 10;                       ///< greatest number of points per frame, 1..1000
  double min_confidence = kProbablyObject;  ///< of a point of `proto`, 0..1; 0 = give all points
  double foa = 64;  ///< diameter of the focus of attention of `wta`, px of the image, 1..1000
};

std::vector<SettingOf<AttentionSettings>> attention_setting_specs();

}  // namespace saccade
