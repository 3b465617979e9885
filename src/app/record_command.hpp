#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "oni/writer.hpp"
#include "settings/settings.hpp"

namespace saccade {

struct RecordArguments {
  std::string source;     ///< SOURCE of SPEC section 7
  std::string file;       ///< the .oni file to make
  double duration_s = 0;  ///< of recorded time; 0 = until the source ends or Ctrl-C
  OniWriterOptions options;
};

/// `saccade record`: records a source to an .oni file until the source ends, the duration or number of
/// frames is reached, or Ctrl-C or SIGTERM comes; the file is closed properly in each case. A live source
/// that is faster than the disk loses frames, which are counted; others wait. Throws Error: the disk is full,
/// the source fails (what came before is kept), the file exists. Of the settings sensor, frames, json and
/// quiet are used.
void record(const RecordArguments& arguments, const Settings& settings);

/// Adds the subcommand; when it is given, parsing sets `action` to what it does.
void add_record_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
