#pragma once

#include <string>

namespace saccade {

/// `text` as the content or a quoted attribute of HTML and SVG: & < > " become entities.
std::string escaped(const std::string& text);

}  // namespace saccade
