#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace saccade {

/// Where OpenNI2 was loaded from and which driver modules it finds there.
struct OpenNi2Installation {
  struct Module {
    std::string name;  ///< "PS1080"
    std::filesystem::path path;
    std::string problem;  ///< why it cannot be loaded; empty = it can
  };
  bool in_this_build = true;  ///< false: SACCADE_OPENNI2=OFF, and there is nothing of the following
  std::filesystem::path library;
  std::string version;  ///< "2.2.0.33"
  std::filesystem::path driver_folder;
  std::vector<Module> modules;
  std::vector<std::string_view> left_out;  ///< those of kOwnModules that this build does not make

  /// nullptr if there is none of this name.
  const Module* module(std::string_view name) const {
    for (const Module& one : modules)
      if (one.name == name) return &one;
    return nullptr;
  }
};

/// The modules of this project, for the Kinect v1 and the virtual device.
inline constexpr std::array<std::string_view, 2> kOwnModules = {"SaccadeFreenect", "SaccadeVirtual"};

/// Examines the OpenNI2 of this process. Loads each module for a moment.
OpenNi2Installation find_openni2();

}  // namespace saccade
