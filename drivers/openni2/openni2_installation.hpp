#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace saccade {

/// Where OpenNI2 was loaded from and which driver modules it finds there.
struct OpenNi2Installation {
  struct Module {
    std::string name;  ///< "PS1080"
    std::filesystem::path path;
    std::string problem;  ///< why it cannot be loaded; empty = it can
  };
  std::filesystem::path library;
  std::string version;  ///< "2.2.0.33"
  std::filesystem::path driver_folder;
  std::vector<Module> modules;

  /// nullptr if there is none of this name.
  const Module* module(const std::string& name) const;
};

/// The modules of this project, without which Kinect v1 and the virtual device are not found.
inline constexpr const char* kOwnModules[] = {"SaccadeFreenect", "SaccadeVirtual"};

/// Looks at the OpenNI2 of this process. Loads each module for a moment.
OpenNi2Installation find_openni2();

}  // namespace saccade
