#include "tests/support/places.hpp"

namespace saccade {

std::string in_source(const std::string& path) {
  return path.empty() ? SACCADE_SOURCE_DIR : SACCADE_SOURCE_DIR "/" + path;
}

std::string in_shared(const std::string& path) { return SACCADE_SHARED_DIR "/" + path; }

std::string saccade_program() { return SACCADE_PROGRAM; }

}  // namespace saccade
