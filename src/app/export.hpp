#pragma once

#include <string>

#include "settings/settings.hpp"

namespace saccade {

struct ExportArguments {
  std::string source;             ///< as open_source() takes it
  std::string out;                ///< folder, made if it does not exist
  std::string format = "folder";  ///< a name of export_formats()
  bool force = false;             ///< also into a folder that holds files
};

/// `saccade export`: writes the selected frames of a source in a format that other programs read, without
/// computing anything, until the source ends or Ctrl-C or SIGTERM comes; the files are complete in each case.
/// Uses the settings frames, sensor, json and quiet. Throws Error: (usage) an unknown format, the folder is
/// not empty, the source has no depth; (unreadable) no frame can be used; (failed) the disk is full, the
/// source fails.
void export_frames(const ExportArguments& arguments, const Settings& settings);

}  // namespace saccade
