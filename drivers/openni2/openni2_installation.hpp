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
    std::string problem{};  ///< why it cannot be loaded; empty = it can
    std::string remedy{};   ///< what to do about it
    bool named = false;     ///< by SACCADE_OPENNI2_DRIVERS, not found in the driver folder
  };
  bool in_this_build = true;  ///< false: SACCADE_OPENNI2=OFF, and there is nothing of the following
  std::filesystem::path library;
  std::string version;  ///< "2.2.0.33"
  std::filesystem::path driver_folder;
  std::filesystem::path redirected_by;  ///< the OpenNI.ini that names driver_folder; empty = none does
  std::vector<Module> modules;
  std::vector<std::string_view> left_out;  ///< those of kOwnModules that this build does not make

  /// nullptr if there is none of this name.
  const Module* module(std::string_view name) const {
    for (const Module& one : modules)
      if (one.name == name) return &one;
    return nullptr;
  }
};

/// The modules of this project: for those of other makers, the Kinect v1 and the virtual device.
inline constexpr std::array<std::string_view, 3> kOwnModules = {"SaccadeBridge", "SaccadeFreenect",
                                                                "SaccadeVirtual"};

/// Examines the OpenNI2 of this process. Loads each module for a moment. `root`: the folder with
/// etc/openni2/OpenNI.ini.
[[nodiscard]] OpenNi2Installation find_openni2(const std::filesystem::path& root);

}  // namespace saccade
