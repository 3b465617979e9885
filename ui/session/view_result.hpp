#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "output/overlay.hpp"
#include "pipeline/result.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// What one set of settings made of a frame.
struct Computed {
  Settings settings;         ///< with which it was computed; the default levels cut to what the frame has
                             ///< room for
  bool draft = false;        ///< of coarser levels; see draft_of()
  RequestedOutputs outputs;  ///< by-products that were asked for
  Result result;             ///< the frame too
  cv::Mat1f smooth;          ///< smooth_for_looking() of the map
  std::vector<Outline> outlines;  ///< proto_outlines() of the fixations
  std::string error;              ///< why there is no map; empty = there is one
};

/// What the viewer shows: one frame, and one or two computations of it. Never changed once it is handed out.
struct ViewResult {
  std::int64_t serial = 0;      ///< of all results of a session, drafts too, from 1
  std::int64_t computed = 0;    ///< so many frames of the session are computed by then, this one too if whole
  std::int64_t generation = 0;  ///< of the wishes it was computed for; see Session::set_compute_request()
  bool draft = false;           ///< A or B is one; the whole is on its way
  Computed a;
  bool compared = false;
  Computed b;  ///< if compared; shares the pixels of a's frame

  const Frame& frame() const { return a.result.frame; }
};

using ViewResultPtr = std::shared_ptr<const ViewResult>;

}  // namespace saccade
