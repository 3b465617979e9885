#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/overlay.hpp"
#include "pipeline/result.hpp"
#include "settings/settings.hpp"
#include "ui/session/sequence_marks.hpp"

namespace saccade {

/// The result of one set of settings for a frame.
struct Computed {
  Settings settings;   ///< of the computation; default levels are cut to those that the frame has room for
  bool draft = false;  ///< of coarser levels; see draft_of()
  RequestedOutputs outputs;            ///< requested by-products
  Result result;                       ///< with the frame
  cv::Mat1f smooth;                    ///< smooth_for_looking() of the map
  std::vector<Outline> outlines;       ///< proto_outlines() of the fixations
  std::optional<SequenceMarks> marks;  ///< of attention over time; none: the frame stands for itself
  std::string error;                   ///< why there is no map; empty = there is one
};

/// What the viewer shows: one frame, and one or two computations of it. Immutable once published.
struct ViewResult {
  std::int64_t serial = 0;      ///< counts all results of a session, with drafts, from 1
  std::int64_t computed = 0;    ///< frames of the session computed so far, without drafts
  std::int64_t generation = 0;  ///< of its request; see Session::set_compute_request()
  bool draft = false;           ///< A or B is a draft; the whole result follows
  Computed a;
  bool compared = false;
  Computed b;  ///< if compared; shares the pixels of a's frame

  const Frame& frame() const { return a.result.frame; }
};

using ViewResultPtr = std::shared_ptr<const ViewResult>;

}  // namespace saccade
