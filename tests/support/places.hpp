#pragma once

#include <string>

namespace saccade {

// Where the tests find what they need. Only places.cpp is compiled with the folders of this checkout, so that
// a compiler cache serves all other tests of another one.

/// A file or folder of the source tree, by its path in it; "" is the tree itself.
std::string in_source(const std::string& path);

/// The same of the labelled scenes and samples beside the source tree, which are not there for everybody.
std::string in_shared(const std::string& path);

/// The program under test.
std::string saccade_program();

}  // namespace saccade
