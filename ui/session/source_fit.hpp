#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "ui/session/compared_settings.hpp"

namespace saccade {

/// Whether the frames of a source are stills, without times: a viewer shows them one by one.
[[nodiscard]] bool has_stills(const SourceInfo& source);

/// Replaces settings that give nothing on a source without depth, and restores them when a source with depth
/// is opened.
class SourceFit {
 public:
  /// Adapts the settings to an open source. Without depth, a 2D model replaces one that needs depth, and the
  /// selector `wta` replaces `proto`; with depth, the replaced choices come back unless the user has chosen
  /// others since. Returns notes about this and about the source for the user, one line each.
  [[nodiscard]] std::vector<std::string> fit(ComparedSettings& settings, const SourceInfo& source);

  /// Restores what fit() replaced, for settings that are saved.
  void restore(ComparedSettings& settings);

 private:
  struct Replaced {
    std::optional<std::string> model;
    std::optional<Selector> selector;
  };
  std::array<Replaced, 2> replaced_;  // of A and of B
};

}  // namespace saccade
