#pragma once

#include <string>

#include "oni/writer.hpp"
#include "settings/settings.hpp"

namespace saccade {

struct RecordArguments {
  std::string source;     ///< as open_source() takes it
  std::string file;       ///< the .oni file to write
  double duration_s = 0;  ///< of recorded time; 0 = until the source ends or Ctrl-C
  OniWriterOptions options;
};

/// `saccade record`: records a source to an .oni file until the source ends, the duration or number of frames
/// is reached, or Ctrl-C or SIGTERM comes; the file is closed properly in each case. If the disk cannot keep
/// up with a live source, frames are dropped and counted; other sources wait for the disk. Uses the settings
/// sensor, frames, json and quiet. Throws Error: the disk is full, the source fails (the frames before it are
/// kept), the file exists.
void record(const RecordArguments& arguments, const Settings& settings);

}  // namespace saccade
