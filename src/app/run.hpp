#pragma once

#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace saccade {

struct RunArguments {
  std::string source;                     ///< as open_source() takes it
  std::string out;                        ///< folder, made if it does not exist
  std::string shard = "1/1";              ///< which part of the frames: parse_shard()
  bool resume = false;                    ///< go on with an earlier run in the folder, if there is one
  std::vector<std::string> command_line;  ///< for the manifest
};

/// `saccade run`: computes every selected frame of the source and writes its files, fixations.jsonl and
/// manifest.json into the folder. Throws Error; the manifest then says so if the folder was made. With
/// `resume` an interruption is an Error too (unfinished).
void run(const RunArguments& arguments, const Settings& settings);

}  // namespace saccade
