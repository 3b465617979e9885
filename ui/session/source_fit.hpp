#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "ui/session/compared_settings.hpp"

namespace saccade {

/// Makes settings that see nothing on a source without depth give something there, and puts back what was
/// chosen when a source with depth comes.
class SourceFit {
 public:
  /// For a source that was opened: where it has no depth, a model of the image takes the place of one that
  /// needs depth, and the selector `wta` that of `proto`; where it has, what was exchanged comes back unless
  /// something else was chosen since. Returns what a person should know of it and of the source, one line
  /// each.
  std::vector<std::string> fit(ComparedSettings& settings, const SourceInfo& source);

  /// Puts back what fit() exchanged, for settings that are to be kept.
  void restore(ComparedSettings& settings);

 private:
  struct Exchanged {
    std::optional<std::string> model;
    std::optional<Selector> selector;
  };
  std::array<Exchanged, 2> exchanged_;  // of A and of B
};

}  // namespace saccade
