#pragma once

#include <string>
#include <string_view>

namespace saccade {

/// The path, or other SOURCE, in a text that a user typed or pasted: its first line that is not empty,
/// without white space and quotation marks around it; a URI "file://..." becomes its path, and a leading "~"
/// the home folder. Empty if there is none, or if it holds control characters or is longer than a path may
/// be.
[[nodiscard]] std::string typed_path(std::string_view text);

}  // namespace saccade
