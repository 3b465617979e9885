#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace saccade {

/// The variable that names driver modules of other makers: files, or folders with them, separated by colons.
inline constexpr const char* kModulesVariable = "SACCADE_OPENNI2_DRIVERS";

/// A property of devices that come from such modules: the file, as a text that ends with 0.
inline constexpr int kModuleFileProperty = 0x53414300;

/// Why a file cannot serve as a driver module, and what to do about it; one line each.
struct ModuleTrouble {
  std::string problem, remedy;
};

/// Loads the file for a moment, which runs its initialisation. std::nullopt: it is a driver module for this
/// machine, and everything that it needs is there.
[[nodiscard]] std::optional<ModuleTrouble> trouble_with_module(const std::filesystem::path& file);

/// The name of a module in a file libNAME.so, libNAME.so.0, ... : NAME; empty if the file is not called so.
[[nodiscard]] std::string module_name(const std::filesystem::path& file);

/// The files that `variable` names, in its order; nullptr = none. Of a folder those that module_name() knows,
/// by name; one file under several names (libX.so -> libX.so.0) is taken once. A path that does not exist is
/// given as it is. Paths are absolute.
[[nodiscard]] std::vector<std::filesystem::path> named_modules(const char* variable);

}  // namespace saccade
