#pragma once

#include <optional>
#include <vector>

#include "ui/panels/probe_drawing.hpp"
#include "ui/panels/view_context.hpp"

namespace saccade {

/// The probe in the side bar. It follows the mouse over the picture and stays at the last pixel when the
/// mouse leaves, or at the pixel at which it is pinned.
class ProbePanel {
 public:
  void draw(ViewContext& view);

 private:
  // The input of the probe.
  struct Source {
    std::int64_t serial;
    bool b;
    cv::Point pixel;
    bool operator==(const Source&) const = default;
  };
  void draw_object(const Computed& computed) const;
  void probe_pixel(const ViewContext& view, const Source& source);
  std::vector<double> weights_of(const Computed& computed, const Symmetry3dParams& params,
                                 const Source& source);

  ProbePanelState state_;
  std::optional<cv::Point> pixel_;
  bool on_b_ = false;
  std::optional<Source> source_;
  std::optional<ProbeShown> shown_;
  // The weights, and the input for which they were computed:
  std::optional<Source> weighed_;
  std::vector<double> weights_;
};

}  // namespace saccade
