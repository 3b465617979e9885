#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/frame_source.hpp"
#include "sources/source_options.hpp"

namespace saccade {

/// Opens what a user names as SOURCE: the first kind of source_kinds() that recognises it. Throws Error:
/// (unreadable) there is no such source, no kind recognises it, or it cannot be read; (usage) the text has a
/// mistake, the kind is not in this build, or one of the InputSettings has no effect on the source.
std::unique_ptr<FrameSource> open_source(const std::string& uri, const SourceOptions& options = {});

/// True if a file's name ends like a source: for lists from which a user chooses. Does not look at the disk.
bool has_source_ending(const std::filesystem::path& file);

/// True if the SOURCE is a device: a sensor or a camera.
bool names_device(const std::string& uri);

/// How SOURCE can be written: "openni2[:URI], synthetic:NAME?KEY=VALUE&..., ...".
std::string source_forms();

/// The table of sources for --help: a title and a line for each kind.
std::string source_help();

}  // namespace saccade
