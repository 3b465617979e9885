#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace saccade {

/// The entries of DT_RUNPATH and DT_RPATH of a 64-bit ELF program or shared library, split at ':'; empty if
/// it has neither. Throws std::runtime_error if the file is cut.
std::vector<std::string> run_path(const std::filesystem::path& file);

/// True if the dynamic loader finds the same folder whatever the working directory: an absolute path, or one
/// from $ORIGIN, the program's own folder.
bool is_fixed(const std::string& entry);

/// The ELF programs and shared libraries below `folder`, without symbolic links.
std::vector<std::filesystem::path> find_binaries(const std::filesystem::path& folder);

}  // namespace saccade
