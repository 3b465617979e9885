#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace saccade {

/// The rooms of the house (folders of sources) from the ground up. A room may use its own files and rooms of
/// lower floors; rooms of one floor do not use each other.
using Floors = std::vector<std::vector<std::string>>;

/// One `#include "TO"` of a file; both paths from the root of the repository.
struct Include {
  std::string from;
  int line = 0;
  std::string to;
};

/// The includes of all .hpp and .cpp files in src/, drivers/ and ui/ of `root`. `to` is looked for in src/
/// and in the root, as the compiler does; a file that is in neither, such as a generated one, counts as in
/// src/.
std::vector<Include> find_includes(const std::filesystem::path& root);

/// The room of a file: its folder. Empty if that is none of `floors`.
std::string room_of(const std::string& file, const Floors& floors);

/// A line "FILE:LINE includes ..." for each include that runs upwards or sideways, or that begins or ends
/// outside of the rooms.
std::vector<std::string> find_upward(const std::vector<Include>& includes, const Floors& floors);

/// A line "a -> b -> a" for each circle of files found.
std::vector<std::string> find_circles(const std::vector<Include>& includes);

}  // namespace saccade
