#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/intrinsics.hpp"

namespace saccade {

/// Names in natural order (learn2 before learn10): by the text before a trailing number, then by the number.
struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const;
};

/// Files by the stem of their names, in natural order.
using FilesByStem = std::map<std::string, std::filesystem::path, NaturalOrder>;

/// The files of a folder with one of the endings (lower case, with the dot; in the folder they may be of any
/// case). Empty if there is no such folder. Throws std::filesystem::filesystem_error if it cannot be listed.
FilesByStem files_of(const std::filesystem::path& folder, const std::vector<std::string>& endings);

/// The first of these folders below `parent` that exists; empty if none does.
std::filesystem::path first_folder(const std::filesystem::path& parent,
                                   const std::vector<std::string_view>& names);

/// The last number in a name: 12 of "scene2_000012_cloud"; std::nullopt if there is none.
std::optional<std::int64_t> last_number(std::string_view name);

/// The first number in a name: 1 of "0000001-000033369"; std::nullopt if there is none.
std::optional<std::int64_t> first_number(std::string_view name);

/// The numbers of a text file of at most `largest_file` bytes, in their order; infinities and NaN are numbers
/// too. Throws Error (unreadable) if it cannot be read or holds something else.
std::vector<double> read_numbers(const std::filesystem::path& file, std::uintmax_t largest_file = 1u << 20);

/// The camera of a 3 x 3 or 4 x 4 matrix (px) of such a file. Throws Error (unreadable) if it is none.
Intrinsics read_camera_matrix(const std::filesystem::path& file);

/// Endings of images that may hold colour.
inline const std::vector<std::string> kColourEndings = {".png", ".jpg", ".jpeg"};

}  // namespace saccade
