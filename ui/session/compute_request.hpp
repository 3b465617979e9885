#pragma once

#include <optional>

#include "models/model.hpp"
#include "ui/session/compared_settings.hpp"

namespace saccade {

/// What to compute of each frame.
struct ComputeRequest {
  Settings a;                  ///< its intrinsics, if it has any, replace the frame's
  std::optional<Settings> b;   ///< of a second computation of the same frame
  RequestedOutputs outputs{};  ///< by-products of both, where the model has them

  bool operator==(const ComputeRequest& other) const {
    return same_settings(a, other.a) && b.has_value() == other.b.has_value() &&
           (!b || same_settings(*b, *other.b)) && outputs == other.outputs;
  }
};

}  // namespace saccade
